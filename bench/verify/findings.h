#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "bench/verify/topology.h"
#include "bench/verify/verify.h"
#include "engine/base/parallel.h"

namespace ccdt::verify {

/// How many failures are described.
constexpr std::size_t kept_failures = 5;

/// Counts a failure. The first few are also described; `describe` is called only for these.
template <class Describe>
void fail(Check& check, const Describe& describe) {
  ++check.failed;
  if (check.examples.size() < kept_failures) check.examples.push_back(describe());
}

/// The failures in a part of a list: how many there are, and the first few.
struct Failures {
  std::uint64_t count = 0;
  std::vector<std::size_t> first = {};

  void add(std::size_t i) {
    ++count;
    if (first.size() < kept_failures) first.push_back(i);
  }
};

/// Adds these failures to the check; describe(i) describes failure i.
template <class Describe>
void fail(Check& check, const Failures& failures, const Describe& describe) {
  for (const std::size_t i : failures.first) fail(check, [&] { return describe(i); });
  check.failed += failures.count - failures.first.size();
}

/// Tests is_right(i) for each i below `count` on several threads, and counts the failures.
///
/// \param describe  describe(i) says what is wrong; called by the caller's thread
template <class IsRight, class Describe>
void check_each(Check& check, std::size_t count, const IsRight& is_right, const Describe& describe) {
  check.checked += count;
  const auto look = [&](std::size_t begin, std::size_t end) {
    Failures failures;
    for (std::size_t i = begin; i < end; ++i)
      if (!is_right(i)) failures.add(i);
    return failures;
  };
  for (const Failures& failures : parallel_chunks(count, chunk_length, look)) fail(check, failures, describe);
}

/// "(x, y, z)" with all digits that distinguish the point from its neighbors.
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
