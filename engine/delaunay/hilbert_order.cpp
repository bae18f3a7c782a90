#include "engine/delaunay/hilbert_order.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/base/box.h"
#include "engine/base/morton.h"
#include "engine/base/parallel.h"

namespace ccdt::delaunay {
namespace {

constexpr int bits_per_axis = 20;
constexpr int round_shift = 3 * bits_per_axis;  // rounds above the 60 bits of the curve

/// Distance along the Hilbert curve of a point of the cube [0, 2^bits)^3 (Skilling 2004: transpose form, then
/// interleaved).
std::uint64_t hilbert_distance(std::array<std::uint32_t, 3> x) {
  for (std::uint32_t q = 1u << (bits_per_axis - 1); q > 1; q >>= 1) {
    const std::uint32_t p = q - 1;
    for (int i = 0; i < 3; ++i) {
      if (x[i] & q) {
        x[0] ^= p;
      } else {
        const std::uint32_t t = (x[0] ^ x[i]) & p;
        x[0] ^= t;
        x[i] ^= t;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1u << (bits_per_axis - 1); q > 1; q >>= 1)
    if (x[2] & q) t ^= q - 1;
  return spread_bits(x[0] ^ t) << 2 | spread_bits(x[1] ^ t) << 1 | spread_bits(x[2] ^ t);
}

/// A well-mixed hash of an index: the random bits of the rounds, the same on every machine.
std::uint64_t random_bits(std::uint64_t i) {
  i += 0x9E3779B97F4A7C15u;
  i = (i ^ (i >> 30)) * 0xBF58476D1CE4E5B9u;
  i = (i ^ (i >> 27)) * 0x94D049BB133111EBu;
  return i ^ (i >> 31);
}

}  // namespace

std::vector<std::uint32_t> hilbert_order(std::span<const Point3> points) {
  const auto [low, high] = bounding_box(points);
  const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1.0});
  const double scale = ((1u << bits_per_axis) - 1) / extent;

  // A round has eight times the points of the one before; small sets need none.
  int rounds = 0;
  for (std::size_t n = points.size(); n > 2000 && rounds < 6; n /= 8) ++rounds;
  std::vector<KeyedIndex> keyed(points.size());
  parallel_for(points.size(), 4096, [&](std::size_t i) {
    const Point3& p = points[i];
    const auto cell = [&](double c, double l) { return static_cast<std::uint32_t>((c - l) * scale); };
    std::uint64_t round = static_cast<std::uint64_t>(rounds);
    for (std::uint64_t bits = random_bits(i); round > 0 && (bits & 7) == 0; bits >>= 3) --round;
    keyed[i] = {round << round_shift | hilbert_distance({cell(p.x, low.x), cell(p.y, low.y), cell(p.z, low.z)}),
                static_cast<std::uint32_t>(i)};
  });
  return sorted_by_key(std::move(keyed));
}

}  // namespace ccdt::delaunay
