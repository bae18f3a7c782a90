#pragma once

#include <cstdio>
#include <string>

#include "bench/verify/verify.h"

namespace ccdt::verify {

/// Counts a failure, and keeps its description if it is among the first few. The description is made only then.
template <class Describe>
void fail(Check& check, const Describe& describe) {
  constexpr std::size_t kept = 5;
  ++check.failed;
  if (check.examples.size() < kept) check.examples.push_back(describe());
}

/// "(x, y, z)" with all digits that tell the point from its neighbors.
inline std::string text(const Point3& p) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, "(%.17g, %.17g, %.17g)", p.x, p.y, p.z);
  return buffer;
}

/// " (x, y, z) (x, y, z) ..."
template <class Vertices>
std::string text(const std::vector<Point3>& points, const Vertices& vertices) {
  std::string s;
  for (const std::uint32_t v : vertices) s += " " + text(points[v]);
  return s;
}

}  // namespace ccdt::verify
