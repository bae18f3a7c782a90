#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/base/hash_table.h"
#include "engine/base/point.h"

namespace ccdt::verify {

/// Points as keys of a hash table. -0 is 0.
struct PointHash {
  static constexpr Point3 none() { return {HUGE_VAL, HUGE_VAL, HUGE_VAL}; }
  static std::size_t hash(const Point3& p) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
    return HashTraits<std::array<std::uint64_t, 3>>::hash({bits(p.x), bits(p.y), bits(p.z)});
  }
};

}  // namespace ccdt::verify
