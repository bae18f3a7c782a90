#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/base/point.h"

namespace ccdt::verify {

/// Points as keys of a hash table. -0 is 0.
struct PointHash {
  static constexpr Point3 none() { return {HUGE_VAL, HUGE_VAL, HUGE_VAL}; }
  static std::size_t hash(const Point3& p) {
    std::uint64_t h = 0;
    for (const double part : as_array(p)) {
      h = (h ^ std::bit_cast<std::uint64_t>(part + 0.0)) * 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    }
    return h;
  }
};

}  // namespace ccdt::verify
