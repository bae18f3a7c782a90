#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/vertex_grid.h"

namespace ccdt {

/// An open face, and a vertex strictly above it as seen from outside (`ghost_vertex`: one is to be searched for).
struct Unfinished {
  std::uint32_t face;
  std::uint32_t candidate;
};

/// Are the open faces the convex hull? They are the border of a body of Delaunay cells that hang together by faces. It
/// is the hull when it is convex, and it is convex when it is so at each of its edges; and then, when it has all
/// vertices. So nobody has to look at all that is above a face of the hull to know that there is nothing.
///
/// \param faces  codes of the open faces
/// \return  faces that are not of the hull: at edges that are not convex; if there are none, those that see a vertex
///          that no cell has
std::vector<Unfinished> find_unfinished(const std::vector<Cell>& cells, std::span<const GridVertex> vertices,
                                        std::span<const std::uint32_t> faces);

/// Adds a ghost for each of the open faces, which are those of the hull, and makes them neighbors.
void add_ghosts(std::vector<Cell>& cells, std::span<const std::uint32_t> faces);

}  // namespace ccdt
