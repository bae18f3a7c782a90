#include "engine/delaunay/block_tops.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ccdt {

BlockTops::Direction& BlockTops::direction(const Point3& normal) {
  // Directions that differ by more than a millionth have different keys.
  const auto part = [](double x) { return static_cast<std::uint64_t>(std::llround(x * 0x1p19) + 0x100000); };
  const std::uint64_t key = (part(normal.x) << 42 | part(normal.y) << 21 | part(normal.z)) + 1;
  Direction& slot = slots_[(key * 0x9E3779B97F4A7C15u >> 32) % slot_count];
  if (slot.key != key) {
    slot.key = key;
    slot.normal = normal;
    slot.tops.assign(grid_.blocks.size(), std::numeric_limits<double>::quiet_NaN());
  }
  return slot;
}

double BlockTops::top(Direction& direction, std::size_t block) const {
  double& top = direction.tops[block];
  if (!std::isnan(top)) return top;
  const GridBlock& b = grid_.blocks[block];
  double highest = -std::numeric_limits<double>::infinity();
  for (int z = b.from[2]; z <= b.to[2]; ++z) {
    for (int y = b.from[1]; y <= b.to[1]; ++y) {
      const std::size_t row = grid_.grid.number({0, y, z});
      for (std::uint32_t v = grid_.first[row + b.from[0]]; v < grid_.first[row + b.to[0] + 1]; ++v)
        highest = std::max(highest, dot(direction.normal, grid_.vertices[v].point));
    }
  }
  top = highest + 1e-15 * (grid_.extent.x + grid_.extent.y + grid_.extent.z);
  return top;
}

}  // namespace ccdt
