#include "engine/base/morton.h"

#include <algorithm>
#include <boost/sort/spreadsort/integer_sort.hpp>
#include <utility>

#include "engine/base/box.h"
#include "engine/base/sort_in_runs.h"

namespace ccdt {

namespace {

bool less(const KeyedIndex& a, const KeyedIndex& b) {
  return a.key != b.key ? a.key < b.key : a.index < b.index;
}

}  // namespace

std::vector<std::uint32_t> sorted_by_key(RawVector<KeyedIndex> items) {
  const auto digits = [](const KeyedIndex& k, unsigned offset) { return k.key >> offset; };
  const auto sort_run = [&](auto first, auto last) {
    boost::sort::spreadsort::integer_sort(first, last, digits, less);
  };
  sort_in_runs(items, sort_run, less);
  std::vector<std::uint32_t> order(items.size());
  parallel_for(items.size(), 4096, [&](std::size_t i) { order[i] = items[i].index; });
  return order;
}

std::vector<std::uint32_t> morton_order(std::span<const Point3> points) {
  const Box box = bounding_box(points);
  const Point3 size = box.high - box.low;
  const double extent = std::max({size.x, size.y, size.z, 1.0});
  constexpr int bits_per_axis = 21;
  const double scale = ((1 << bits_per_axis) - 1) / extent;
  RawVector<KeyedIndex> keyed(points.size());
  parallel_for(points.size(), 4096, [&](std::size_t i) {
    keyed[i] = {morton_code_at(scale * (points[i] - box.low)), static_cast<std::uint32_t>(i)};
  });
  return sorted_by_key(std::move(keyed));
}

}  // namespace ccdt
