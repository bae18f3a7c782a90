#pragma once

#include <cstdint>

#include "bench/experiments/small_plcs/families.h"
#include "bench/experiments/small_plcs/tetrahedralization.h"

/// The parts that families are made of.
namespace ccdt::small {

Point random_point(Random& random);

/// The convex hull, as boundary. \pre no four vertices are coplanar
std::vector<Polygon> convex_hull(const std::vector<Point>& vertices);

/// The faces of only one of the tetrahedra, counterclockwise from outside.
std::vector<Polygon> boundary_of(const std::vector<Point>& vertices, const std::vector<Tetrahedron>& tetrahedra);

/// Glues tetrahedra to tetrahedra until there are so many vertices. Nothing is glued to faces of the `closed` corners.
/// Most of the new tetrahedra bring a vertex of their own.
void glue_tetrahedra(Random& random, std::size_t vertices, const Polygon& closed, SmallPlc& plc,
                     std::vector<Tetrahedron>& tetrahedra);

/// Pushes triangles of the boundary in: each becomes three that meet in a new vertex.
void push_in_triangles(Random& random, std::uint64_t count, SmallPlc& plc);

/// Adds facets and segments within the domain where there is place for them; `count` times one is tried.
void add_triangles(Random& random, std::uint64_t count, SmallPlc& plc);
void add_segments(Random& random, std::uint64_t count, SmallPlc& plc);

}  // namespace ccdt::small
