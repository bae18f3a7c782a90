#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/base/index.h"

namespace ccdt::protection {

/// A vertex on a segment.
struct ChainVertex {
  VertexId vertex;
  std::uint32_t fraction = 0;  ///< where: multiples of 1 / whole_segment from the segment's first end
  std::uint32_t level = 0;  ///< one more than the greater level of the two ends of the piece that it split; 0: an end
};

inline constexpr std::uint32_t whole_segment = 1u << 30;

/// Multiples of this fraction, 2^-20, are on the grid on every segment.
inline constexpr std::uint32_t usual_step = whole_segment >> 20;

/// The chains of the segments of a PLC: for each segment the vertices on it, from its first end (fraction 0) to its
/// second (`whole_segment`).
using SegmentChains = std::vector<std::vector<ChainVertex>>;

/// Did protection split the segment? Vertices that refinement gave it do not count.
inline bool is_split(const std::vector<ChainVertex>& chain) {
  return std::ranges::any_of(chain, [](const ChainVertex& v) { return v.level > 0; });
}

}  // namespace ccdt::protection
