#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/base/hash_table.h"
#include "engine/base/index.h"
#include "engine/base/point.h"

namespace ccdt::sizes {

/// The cube that contains a point, in a facet's grid. The edges of its cubes are the largest power of two not above a
/// size.
struct SampleCell {
  std::array<std::int64_t, 3> place;
  std::int32_t exponent;
  FacetId facet;

  bool operator==(const SampleCell&) const = default;
};

}  // namespace ccdt::sizes

template <>
struct ccdt::HashTraits<ccdt::sizes::SampleCell> {
  static constexpr sizes::SampleCell none() { return {{}, 0, {}}; }
  static std::size_t hash(const sizes::SampleCell& cell) {
    const auto& [x, y, z] = cell.place;
    return HashTraits<std::array<std::int64_t, 5>>::hash({x, y, z, cell.exponent, cell.facet.value});
  }
};

namespace ccdt::sizes {

/// \param size  > 0
inline SampleCell cell_of(const Point3& p, double size, FacetId facet = FacetId(0u)) {
  int exponent = 0;
  std::frexp(size, &exponent);
  const auto place = [&](double x) { return static_cast<std::int64_t>(std::floor(std::ldexp(x, 1 - exponent))); };
  return {{place(p.x), place(p.y), place(p.z)}, exponent, facet};
}

}  // namespace ccdt::sizes
