#include "engine/delaunay/hilbert_order.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "engine/base/box.h"
#include "engine/base/morton.h"
#include "engine/base/parallel.h"
#include "engine/geometry/filters.h"

namespace ccdt::delaunay {
namespace {

constexpr int bits_per_axis = 20;
constexpr int round_shift = 3 * bits_per_axis;  // rounds above the 60 bits of the curve

constexpr std::size_t lanes = 8;  ///< points that are computed at the same time
using Coordinates = std::array<std::array<std::uint32_t, lanes>, 3>;

using NumberLanes = std::uint32_t __attribute__((vector_size(32)));

/// Distances along the Hilbert curve of points of the cube [0, 2^bits)^3 (Skilling 2004: transpose form, then
/// interleaved), without branches.
CCDT_WIDE_LANES void hilbert_distances(const Coordinates& coordinates, std::array<std::uint64_t, lanes>& distances) {
  NumberLanes x, y, z;
  std::memcpy(&x, &coordinates[0], sizeof x);
  std::memcpy(&y, &coordinates[1], sizeof y);
  std::memcpy(&z, &coordinates[2], sizeof z);
  for (int bit = bits_per_axis - 1; bit > 0; --bit) {
    // Inverts the lower bits of the first axis, or exchanges them with those of another axis.
    const NumberLanes below = NumberLanes{} + ((1u << bit) - 1);
    x ^= below & -(x >> bit & 1u);
    const NumberLanes y_is_set = -(y >> bit & 1u), with_y = (x ^ y) & below & ~y_is_set;
    x ^= with_y | (below & y_is_set);
    y ^= with_y;
    const NumberLanes z_is_set = -(z >> bit & 1u), with_z = (x ^ z) & below & ~z_is_set;
    x ^= with_z | (below & z_is_set);
    z ^= with_z;
  }
  y ^= x;
  z ^= y;
  // Gray code: a bit is inverted once for each higher bit that is set.
  NumberLanes t = z >> 1;
  for (int shift = 1; shift < bits_per_axis; shift *= 2) t ^= t >> shift;
  x ^= t, y ^= t, z ^= t;
  for (std::size_t lane = 0; lane < lanes; ++lane)
    distances[lane] = spread_bits(x[lane]) << 2 | spread_bits(y[lane]) << 1 | spread_bits(z[lane]);
}

/// Divides items along a curve into rounds: each takes three items between any two of the rounds before.
std::vector<std::uint32_t> in_rounds(const std::vector<std::uint32_t>& along_curve) {
  constexpr std::size_t growth = 4, most_in_first = 1000;
  std::size_t step = 1;
  while (along_curve.size() / step > most_in_first) step *= growth;
  std::vector<std::uint32_t> result;
  result.reserve(along_curve.size());
  for (std::size_t i = 0; i < along_curve.size(); i += step) result.push_back(along_curve[i]);
  for (std::size_t last = step; last > 1; last = step) {
    step /= growth;
    for (std::size_t i = 0; i < along_curve.size(); i += step)
      if (i % last != 0) result.push_back(along_curve[i]);
  }
  return result;
}

}  // namespace

std::vector<std::uint32_t> hilbert_order(std::span<const Point3> points, std::span<const std::uint8_t> later_rounds) {
  const auto [low, high] = bounding_box(points);
  const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1.0});
  const double scale = ((1u << bits_per_axis) - 1) / extent;

  RawVector<KeyedIndex> keyed(points.size());
  const auto round_of = [&](std::size_t i) {
    constexpr std::uint64_t last = (std::uint64_t{1} << (64 - round_shift)) - 1;
    return later_rounds.empty() ? last : last - std::min<std::uint64_t>(later_rounds[i], last);
  };
  parallel_ranges(points.size(), 4096, [&](std::size_t i, std::size_t end) {
    Coordinates cells{};
    std::array<std::uint64_t, lanes> distances;
    for (; i < end; i += lanes) {
      const std::size_t count = std::min(lanes, end - i);
      for (std::size_t lane = 0; lane < count; ++lane) {
        const Point3 p = scale * (points[i + lane] - low);
        cells[0][lane] = static_cast<std::uint32_t>(p.x);
        cells[1][lane] = static_cast<std::uint32_t>(p.y);
        cells[2][lane] = static_cast<std::uint32_t>(p.z);
      }
      hilbert_distances(cells, distances);
      for (std::size_t lane = 0; lane < count; ++lane)
        keyed[i + lane] = {round_of(i + lane) << round_shift | distances[lane], static_cast<std::uint32_t>(i + lane)};
    }
  });
  std::vector<std::uint32_t> sorted = sorted_by_key(std::move(keyed));
  return later_rounds.empty() ? in_rounds(sorted) : sorted;
}

}  // namespace ccdt::delaunay
