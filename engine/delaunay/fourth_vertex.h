#pragma once

#include <array>
#include <cstdint>

#include "engine/delaunay/block_tops.h"
#include "engine/delaunay/sphere_pencil.h"
#include "engine/delaunay/vertex_grid.h"

namespace ccdt {

/// How much to search.
enum class Reach {
  near,       ///< not what is above a face of the hull, nor a huge sphere, which is nearly a half-space as well
  everywhere  ///< all that is above the face
};

/// Finds the vertex that makes a Delaunay tetrahedron of a Delaunay face (paper, sections 4 and 5; Fang and Piegl 1993
/// for the plane): a spiral search around the face in growing boxes of cells finds a candidate; it is replaced by any
/// vertex inside the sphere through it and the face, until the cells that the sphere meets above the face have all been
/// seen. Where the sphere is large, blocks of cells are passed over at once.
class FourthVertexSearch {
 public:
  /// \param grid  must outlive the search
  explicit FourthVertexSearch(const VertexGrid& grid) : grid_(grid), tops_(grid) {}

  /// \param face       of the Delaunay tetrahedralization; the search is above it
  /// \param candidate  a vertex strictly above the face, to start with; `ghost_vertex` to search for one
  /// \return  `ghost_vertex` if there is no vertex strictly above the face, or none has been found within reach
  std::uint32_t find(const std::array<std::uint32_t, 3>& face, std::uint32_t candidate, Reach reach);

 private:
  const VertexGrid& grid_;
  BlockTops tops_;
  VertexBatch batch_;
};

}  // namespace ccdt
