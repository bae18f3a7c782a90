#pragma once

#include <array>
#include <cstddef>

#include "engine/base/point.h"

namespace ccdt::sizes {

using Triangle = std::array<Point3, 3>;

/// The same triangle, with the longest edge between its first two corners.
inline Triangle longest_edge_first(const Triangle& t) {
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (squared_length(t[(i + 1) % 3] - t[i]) > squared_length(t[(longest + 1) % 3] - t[longest])) longest = i;
  return {t[longest], t[(longest + 1) % 3], t[(longest + 2) % 3]};
}

}  // namespace ccdt::sizes
