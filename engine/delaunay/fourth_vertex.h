#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/index_lists.h"
#include "engine/base/uniform_grid.h"
#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/sphere_pencil.h"

namespace ccdt::delaunay {

/// A cube of cells that has vertices.
struct GridBlock {
  static constexpr int side = 8;

  UniformGrid::CellIndex from{}, to{};  ///< its cells, both ends included
  Point3 center, half;                  ///< of the box of its vertices; slightly larger
};

/// Vertices in the order of the cells of a uniform grid (paper, section 4), so that those of a row of cells are
/// adjacent: those of cell c are first[c] .. first[c + 1]. Below, a vertex is named by its place in this order.
struct VertexGrid {
  UniformGrid grid;
  Point3 extent;  ///< of the points
  std::vector<std::uint32_t> first;
  std::vector<GridVertex> vertices;
  std::vector<GridBlock> blocks;

  /// Calls visit(point) for the vertices of a box of cells, both ends included.
  template <class Visit>
  void for_each_vertex(const UniformGrid::CellIndex& from, const UniformGrid::CellIndex& to, const Visit& visit) const {
    for (int z = from[2]; z <= to[2]; ++z) {
      for (int y = from[1]; y <= to[1]; ++y) {
        const std::size_t row = grid.number({0, y, z});
        for (std::uint32_t v = first[row + from[0]]; v < first[row + to[0] + 1]; ++v) visit(vertices[v].point);
      }
    }
  }
};

/// \param scale  factor of the paper's cell size
VertexGrid make_vertex_grid(std::span<const DelaunayVertex> vertices, double scale);

/// A cache of how far the vertices of each block of a grid reach in a direction. Many faces of a flat side of a part
/// ask for nearly the same direction. A bounding box around vertices on a slanted side reaches far above it, and the
/// spheres there are nearly half-spaces, because their rounded vertices are slightly off a plane.
class BlockTops {
 public:
  explicit BlockTops(const VertexGrid& grid) : grid_(grid), slots_(slot_count) {}

  struct Direction {
    Point3 normal;             ///< of unit length, near the requested one
    std::vector<double> tops;  ///< of blocks, along the normal; NaN: not known yet
    std::uint64_t key = 0;
  };
  /// The cached values for about this direction. \param normal  of unit length
  Direction& direction(const Point3& normal);
  /// An upper bound of normal . p over all vertices p of the block, exact up to rounding.
  double top(Direction& direction, std::size_t block) const;

 private:
  static constexpr std::size_t slot_count = 1024;

  const VertexGrid& grid_;
  std::vector<Direction> slots_;
};

/// The extent of a search.
enum class Reach {
  near,       ///< gives up if the face may be on the hull, or the sphere is so large that it is nearly a half-space
  everywhere  ///< searches everything above the face
};

/// Finds the vertex that makes a Delaunay tetrahedron with a Delaunay face (paper, sections 4 and 5; Fang and Piegl
/// 1993 for the plane): a spiral search around the face in growing boxes of cells finds a candidate; any vertex inside
/// the sphere through the candidate and the face replaces it, until all cells that the sphere meets above the face have
/// been visited. If the sphere is large, whole blocks of cells are skipped.
class FourthVertexSearch {
 public:
  /// \param grid  must outlive the search
  explicit FourthVertexSearch(const VertexGrid& grid) : grid_(grid), tops_(grid) {}

  /// \param face       of the Delaunay tetrahedralization; the search is above it
  /// \param candidate  a vertex strictly above the face, to start with; `ghost_vertex` to search for one
  /// \return  `ghost_vertex` if there is no vertex strictly above the face, or none was found within reach
  std::uint32_t find(const std::array<std::uint32_t, 3>& face, std::uint32_t candidate, Reach reach);

 private:
  const VertexGrid& grid_;
  BlockTops tops_;
  VertexBatch batch_;
};

}  // namespace ccdt::delaunay
