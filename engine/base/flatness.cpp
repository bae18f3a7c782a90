#include "engine/base/flatness.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/base/box.h"

namespace ccdt {
namespace {

/// How far a vertex may be from the plane of its facet, in roundings of the largest coordinate: it moves by at most the
/// square root of three of them. Four would join facets across walls that thin.
constexpr double most_roundings = 2;

bool is_single(double x) {
  return std::fabs(x) <= std::numeric_limits<float>::max() && static_cast<double>(static_cast<float>(x)) == x;
}

/// For a number of single precision.
bool uses_last_bit(double x) {
  return (std::bit_cast<std::uint32_t>(static_cast<float>(x)) & 1) != 0;
}

/// Are all coordinates of single precision, and have some been rounded to it? Numbers that need fewer bits, like
/// integers, are probably exact.
bool are_rounded_to_single(std::span<const Point3> points) {
  const auto all = [](const Point3& p, const auto& holds) { return holds(p.x) && holds(p.y) && holds(p.z); };
  const auto any = [](const Point3& p, const auto& holds) { return holds(p.x) || holds(p.y) || holds(p.z); };
  return std::ranges::all_of(points, [&](const Point3& p) { return all(p, is_single); }) &&
         std::ranges::any_of(points, [&](const Point3& p) { return any(p, uses_last_bit); });
}

}  // namespace

double flatness_for(std::span<const Point3> points, double tolerance) {
  if (tolerance != usual_flatness) return tolerance;
  const double rounding = are_rounded_to_single(points) ? 0x1p-24 : 0x1p-53;
  const double extent = largest_extent(points);
  return extent > 0 ? std::max(tolerance, most_roundings * rounding * largest_coordinate(points) / extent) : tolerance;
}

}  // namespace ccdt
