#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string_view>
#include <vector>

#include "bench/experiments/small_plcs/small_plc.h"

namespace ccdt::small_plcs {

/// Numbers that are the same on every machine. (The distributions of the standard library are not.)
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// 0 to `count` - 1.
  std::uint64_t below(std::uint64_t count) { return engine_() % count; }
  /// Both ends included.
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(high - low + 1)));
  }

 private:
  std::mt19937_64 engine_;
};

/// A way to make random PLCs.
struct Family {
  std::string_view name;
  std::string_view what;      ///< one sentence
  bool is_cospherical;        ///< all vertices are on one sphere: outside of the theorem
  SmallPlc (*make)(Random&);  ///< may make one that is not valid or generic
};
std::span<const Family> families();

/// The next one of a family that is valid and, as far as the family is to be, generic.
SmallPlc next_plc(const Family& family, Random& random);

Point random_point(Random& random);

/// The convex hull, as boundary. \pre no four vertices are coplanar
std::vector<Polygon> convex_hull(const std::vector<Point>& vertices);

}  // namespace ccdt::small_plcs
