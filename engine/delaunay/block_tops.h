#pragma once

#include <cstdint>
#include <vector>

#include "engine/delaunay/vertex_grid.h"

namespace ccdt {

/// How far the vertices of the blocks of a grid reach in a direction: remembered, as many faces of a flat side of a
/// part ask in nearly the same direction. A box around vertices on a slanted side reaches far above it, and the spheres
/// there are all but half-spaces: their rounded vertices are a hair off a plane.
class BlockTops {
 public:
  explicit BlockTops(const VertexGrid& grid) : grid_(grid), slots_(slot_count) {}

  struct Direction {
    Point3 normal;             ///< of unit length, near the one asked for
    std::vector<double> tops;  ///< of blocks, along the normal; NaN: not known yet
    std::uint64_t key = 0;
  };
  /// What is remembered for about this direction. \param normal  of unit length
  Direction& direction(const Point3& normal);
  /// At least the largest normal . p of all vertices p of the block, by not more than roundings.
  double top(Direction& direction, std::size_t block) const;

 private:
  static constexpr std::size_t slot_count = 1024;

  const VertexGrid& grid_;
  std::vector<Direction> slots_;
};

}  // namespace ccdt
