#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/point.h"

namespace ccdt::test {

/// A polyhedron, which may contain further vertices and segments.
struct Polyhedron {
  std::vector<Point3> vertices;                         ///< whole numbers
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of the surface, counterclockwise from outside
  std::vector<std::array<std::uint32_t, 2>> segments;   ///< more edges that are required, besides those of the surface
};

/// No four vertices are in a plane, no five on a sphere.
bool is_generic(const Polyhedron& polyhedron);

struct Tetrahedralizations {
  std::size_t all = 0;
  std::size_t constrained_delaunay = 0;  ///< of these; 0 or 1 by the theory
};

/// Tries and counts all ways to fill a generic polyhedron of few vertices with tetrahedra on its vertices that use all
/// of them. A way is constrained Delaunay if all its inner faces are locally Delaunay (Shewchuk 2008, the Delaunay
/// lemma for constrained tetrahedralizations).
Tetrahedralizations count_tetrahedralizations(const Polyhedron& polyhedron);

}  // namespace ccdt::test
