#include "engine/numbers/morton.h"

#include <algorithm>
#include <boost/sort/spreadsort/integer_sort.hpp>
#include <limits>

namespace ccdt {

namespace {

struct Keyed {
  std::uint64_t key;
  std::uint32_t index;
};

}  // namespace

std::vector<std::uint32_t> morton_order(std::span<const Point3> points) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Point3 low{inf, inf, inf}, high{-inf, -inf, -inf};
  for (const Point3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Point3 size = high - low;
  const double extent = std::max({size.x, size.y, size.z, 1.0});
  constexpr int bits_per_axis = 21;
  const double scale = ((1 << bits_per_axis) - 1) / extent;
  std::vector<Keyed> keyed(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Point3 p = scale * (points[i] - low);
    keyed[i] = {spread_bits(static_cast<std::uint64_t>(p.x)) | spread_bits(static_cast<std::uint64_t>(p.y)) << 1 |
                    spread_bits(static_cast<std::uint64_t>(p.z)) << 2,
                i};
  }
  boost::sort::spreadsort::integer_sort(
      keyed.begin(), keyed.end(), [](const Keyed& k, unsigned offset) { return k.key >> offset; },
      [](const Keyed& a, const Keyed& b) { return a.key != b.key ? a.key < b.key : a.index < b.index; });
  std::vector<std::uint32_t> order(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) order[i] = keyed[i].index;
  return order;
}

}  // namespace ccdt
