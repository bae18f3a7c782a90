#pragma once

#include <algorithm>
#include <cmath>

#include "engine/base/count_work.h"
#include "engine/plc/plc.h"
#include "engine/sizes/size_field.h"

namespace ccdt::sizes {

/// About how many triangles cover the facets if their edges have the lengths of a size field; any number above `most`
/// if there are more.
double count_triangles(const plc::Plc& plc, const SizeField& field, double most = HUGE_VAL);

/// How many triangles short edges may add to a surface that has `even` triangles without them: several times as many,
/// or some thousands if `even` is small.
inline double affordable_triangles(double even) {
  return std::max(10000.0, 4 * even);
}

/// The least affordable lower limit for lengths, between two given lengths; up to a quarter too large if these differ
/// by a factor of 1,000.
///
/// \param is_affordable  true for the largest length, and for all lengths above an affordable one
template <class IsAffordable>
double least_affordable(double least, double largest, const IsAffordable& is_affordable) {
  if (is_affordable(least)) return least;
  ++work_done.feature_triangles;
  for (int i = 0; i < 5; ++i) {
    const double middle = std::sqrt(least * largest);
    (is_affordable(middle) ? largest : least) = middle;
  }
  return largest;
}

}  // namespace ccdt::sizes
