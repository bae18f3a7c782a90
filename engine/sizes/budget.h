#pragma once

#include <algorithm>
#include <cmath>

#include "engine/base/count_work.h"
#include "engine/plc/plc.h"
#include "engine/sizes/size_field.h"

namespace ccdt::sizes {

/// About how many triangles cover the facets if their edges have the lengths of a field of places; any number above
/// `most` if there are more.
double count_triangles(const plc::Plc& plc, const SizeField& field, double most = HUGE_VAL);

/// How many triangles short edges may add to a surface that has `even` without them: several times as many, or some
/// thousands if these are few.
inline double affordable_triangles(double even) {
  return std::max(10000.0, 4 * even);
}

/// The least length, between two, to which shorter ones may be limited; up to a quarter if they differ by 1,000 times.
///
/// \param is_affordable  true for the largest length, and for all that are longer than one for which it is true
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
