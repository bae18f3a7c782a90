#include "engine/base/morton.h"

#include <algorithm>
#include <boost/sort/spreadsort/integer_sort.hpp>

#include "engine/base/box.h"

namespace ccdt {

std::vector<std::uint32_t> sorted_by_key(std::vector<KeyedIndex> items) {
  boost::sort::spreadsort::integer_sort(
      items.begin(), items.end(), [](const KeyedIndex& k, unsigned offset) { return k.key >> offset; },
      [](const KeyedIndex& a, const KeyedIndex& b) { return a.key != b.key ? a.key < b.key : a.index < b.index; });
  std::vector<std::uint32_t> order(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) order[i] = items[i].index;
  return order;
}

std::vector<std::uint32_t> morton_order(std::span<const Point3> points) {
  const Box box = bounding_box(points);
  const Point3 size = box.high - box.low;
  const double extent = std::max({size.x, size.y, size.z, 1.0});
  constexpr int bits_per_axis = 21;
  const double scale = ((1 << bits_per_axis) - 1) / extent;
  std::vector<KeyedIndex> keyed(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) keyed[i] = {morton_code_at(scale * (points[i] - box.low)), i};
  return sorted_by_key(std::move(keyed));
}

}  // namespace ccdt
