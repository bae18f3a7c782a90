#pragma once

#include <string>

#include "bench/verify/verify.h"

namespace ccdt::verification {

/// A check that nothing has gone through yet.
Check make_check(std::string name, bool required = true);

/// Counts a failure, and keeps its description if it is among the first few. The description is made only then.
template <class Describe>
void fail(Check& check, const Describe& describe) {
  constexpr std::size_t kept = 5;
  ++check.failed;
  if (check.examples.size() < kept) check.examples.push_back(describe());
}

/// "(x, y, z)" with all digits that tell the point from its neighbours.
std::string text(const Point3& p);

}  // namespace ccdt::verification
