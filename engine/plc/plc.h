#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/point.h"
#include "engine/geometry/grid.h"
#include "engine/plc/periodicity.h"

namespace ccdt::plc {

/// The triangle is not a face of a simplicial complex, or may not be one.
inline constexpr std::uint32_t no_face = none;

/// A segment of the PLC: a straight edge that the mesh must contain as a chain of edges.
struct Segment {
  std::array<VertexId, 2> ends;
  int marker = 0;
  bool grazeable = false;        ///< the domain spans 180 degrees or more around it (Shewchuk 2002)
  bool touching = false;         ///< the domain touches itself along it: more than two triangles there bound the domain
  std::uint32_t face = no_face;  ///< of a triangle at it, in `Plc::faces`; then the segment is an edge there
  bool listed = true;            ///< in or on the domain; not a fold, of which the input knows nothing
};

/// A facet: a maximal connected coplanar patch of input facets with one marker, bounded by segments.
///
/// `above` is the side that the normals of its triangles point to (right-hand rule, counterclockwise as seen from
/// above).
struct Facet {
  std::uint32_t first_triangle = 0, triangle_count = 0;  ///< in `Plc::triangles`
  bool exactly_flat = true;                              ///< false: flat only within the tolerance
  int marker = 0;
  std::uint32_t number = 0;  ///< number in the file of one input facet in it, for messages
  RegionId above, below;
};

/// A part of space that the facets do not divide further. Region 0 is the one that reaches infinity.
struct Region {
  bool inside = false;        ///< belongs to the domain
  int attribute = 0;          ///< attribute of the mesh's cells in it
  double largest_volume = 0;  ///< of the mesh's cells in it, in the units of the input; 0: any
};

/// A piecewise linear complex, checked and ready to be meshed (paper, section 2).
///
/// Invariants: vertices are distinct and multiples of `DyadicGrid::quantum`; segments and facets meet only in common
/// vertices and segments; a vertex of the PLC that lies on a segment splits it and one that lies in a facet is a vertex
/// of its triangulation; every boundary edge of a facet is a segment.
struct Plc {
  std::string name;
  DyadicGrid grid;
  std::vector<Point3> vertices;           ///< grid units
  std::vector<Point3> world;              ///< the same vertices in the units of the input, unrounded
  std::vector<VertexId> vertex_of_input;  ///< for each input vertex, its vertex
  std::vector<Segment> segments;
  std::vector<Facet> facets;
  std::vector<std::array<VertexId, 3>> triangles;  ///< of all facets, one facet after another
  std::vector<std::uint32_t> faces;  ///< by triangle: its face in a simplicial complex that has all vertices, such as
                                     ///< their Delaunay tetrahedralization; or `no_face`
  std::vector<Region> regions;
  std::vector<Point3> idle_holes;  ///< seeds of holes where nothing is enclosed anyway, in the units of the input
  double largest_rounding = 0;     ///< largest change of a coordinate by the grid, in the units of the input
  Periodicity periodicity = Periodicity::none;  ///< which opposite sides are equal; see `find_repeats`

  /// Any triangulation of a facet, with all of its vertices, consistently oriented.
  std::span<const std::array<VertexId, 3>> triangles_of(const Facet& facet) const {
    return std::span(triangles).subspan(facet.first_triangle, facet.triangle_count);
  }
  /// Adds a facet with these triangles.
  void add(Facet facet, std::span<const std::array<VertexId, 3>> its_triangles) {
    facet.first_triangle = static_cast<std::uint32_t>(triangles.size());
    facet.triangle_count = static_cast<std::uint32_t>(its_triangles.size());
    facets.push_back(facet);
    triangles.insert(triangles.end(), its_triangles.begin(), its_triangles.end());
    faces.resize(triangles.size(), no_face);
  }
};

/// The normal of a facet, as long as twice its area.
inline Point3 sum_of_normals(std::span<const std::array<VertexId, 3>> triangles, std::span<const Point3> points) {
  Point3 sum;
  for (const auto& [a, b, c] : triangles) sum = sum + area_vector({points[a], points[b], points[c]});
  return sum;
}

}  // namespace ccdt::plc
