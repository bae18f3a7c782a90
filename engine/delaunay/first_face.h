#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "engine/delaunay/vertex_grid.h"

namespace ccdt {

/// A face of the Delaunay tetrahedralization from which it can be built face by face: one of the convex hull, found by
/// wrapping a plane around the points: a vertex, an edge, the plane of a hull face, a Delaunay triangle in that plane.
/// Each step is one pass over the vertices.
///
/// \return  its corners, the outside of the hull above them; nothing if all vertices are in one plane
std::optional<std::array<std::uint32_t, 3>> find_first_face(std::span<const GridVertex> vertices);

}  // namespace ccdt
