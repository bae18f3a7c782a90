#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/experiments/small_plcs/integer_geometry.h"
#include "engine/plc/input.h"

namespace ccdt::small {

using Vertex = std::uint32_t;
using Edge = std::array<Vertex, 2>;      ///< in growing order
using Triangle = std::array<Vertex, 3>;  ///< in growing order where it is a face of tetrahedra
using Polygon = std::vector<Vertex>;     ///< the corners of a facet in order, three or four

/// A piecewise linear complex of a few vertices.
///
/// Invariants (`is_valid`, `is_generic`): the boundary is closed and bounds one body without a void; facets and
/// segments are in the domain and meet only in common corners and edges; of the corners of a facet of four, no three
/// are collinear and at most one is reflex.
struct SmallPlc {
  std::vector<Point> vertices;
  std::vector<Polygon> boundary;       ///< counterclockwise seen from outside
  std::vector<Polygon> interior = {};  ///< facets with the domain on both sides
  std::vector<Edge> segments = {};     ///< that are no edges of facets
};

Edge edge_of(Vertex a, Vertex b);
Triangle triangle_of(Vertex a, Vertex b, Vertex c);

/// Along the normal from which the corners are counterclockwise, and as long as twice the area.
Point area_vector(const SmallPlc& plc, const Polygon& polygon);

/// A facet cut into triangles along a diagonal that is within it, in the order of its corners.
std::vector<Triangle> triangles_of(const SmallPlc& plc, const Polygon& polygon);

/// Is the triangle of three corners of a facet within it, if none of the other corners is in the triangle?
bool is_within(const SmallPlc& plc, const Polygon& polygon, const Triangle& triangle);

/// Those of the boundary and the interior ones.
std::vector<Polygon> all_facets(const SmallPlc& plc);
/// The edges of all facets and the segments, each once, sorted.
std::vector<Edge> all_segments(const SmallPlc& plc);

std::int64_t six_volumes(const SmallPlc& plc);

/// Is the centre of the vertices of a simplex inside of the domain, and not on its boundary?
bool is_inside(const SmallPlc& plc, const std::vector<Vertex>& simplex);

/// Are no four vertices in a plane (but corners of a facet), and no five on a sphere?
bool is_generic(const SmallPlc& plc, bool may_be_cospherical = false);

/// Is the boundary one surface, do no edges pierce facets or cut them in two, is the volume positive, and are interior
/// facets and segments inside?
bool is_valid(const SmallPlc& plc);

InputPlc as_input(const SmallPlc& plc);

/// All of it on one line, for a person who wants to build it again.
std::string in_words(const SmallPlc& plc);

}  // namespace ccdt::small
