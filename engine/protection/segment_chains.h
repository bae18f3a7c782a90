#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/index.h"
#include "engine/plc/plc.h"

namespace ccdt::protection {

/// A vertex on a segment.
struct ChainVertex {
  VertexId vertex;
  std::uint32_t fraction = 0;  ///< where: multiples of 1 / whole_segment from the segment's first end
  std::uint32_t level = 0;     ///< one more than the greater level of the ends of the piece that it split; 0: an end
};

inline constexpr std::uint32_t whole_segment = 1u << 30;

/// Multiples of this fraction, 2^-20, are on the grid on every segment.
inline constexpr std::uint32_t usual_step = whole_segment >> 20;

/// The point at a fraction of a segment; exact if it is on the grid.
inline Point3 point_on_segment(const plc::Plc& plc, std::uint32_t segment, std::uint32_t fraction) {
  const auto& [a, b] = plc.segments[segment].ends;
  return plc.vertices[a] + fraction * ((1.0 / whole_segment) * (plc.vertices[b] - plc.vertices[a]));
}

/// A vertex inside a segment.
struct InnerVertex {
  std::uint32_t segment;
  ChainVertex vertex;
};

/// The chains of the segments of a PLC: for each segment the vertices on it, from its first end (fraction 0) to its
/// second (`whole_segment`). All are in one array, since most segments have only their ends.
class SegmentChains {
 public:
  SegmentChains() = default;
  /// Segments without inner vertices.
  explicit SegmentChains(std::span<const plc::Segment> segments) { append(segments); }
  /// Adds segments without inner vertices.
  void append(std::span<const plc::Segment> segments);

  bool empty() const { return begins_.empty(); }
  std::size_t size() const { return empty() ? 0 : begins_.size() - 1; }
  std::span<const ChainVertex> operator[](std::size_t segment) const {
    return {vertices_.data() + begins_[segment], vertices_.data() + begins_[segment + 1]};
  }
  bool have_inner_vertices() const { return vertices_.size() > 2 * size(); }
  /// The ends of the pieces of all segments.
  std::vector<std::array<VertexId, 2>> pieces() const;

  void insert(std::vector<InnerVertex> added);

  /// Removes vertices inside segments.
  template <class IsGone>
  void erase_if(const IsGone& is_gone) {
    std::uint32_t kept = 0, begin = 0;
    for (std::size_t s = 0; s < size(); ++s) {
      const std::uint32_t end = begins_[s + 1];
      for (std::uint32_t i = begin; i < end; ++i)
        if (!is_gone(vertices_[i])) vertices_[kept++] = vertices_[i];
      begins_[s + 1] = kept;
      begin = end;
    }
    vertices_.resize(kept);
  }

 private:
  std::vector<std::uint32_t> begins_;  // by segment, and the end of the last one
  std::vector<ChainVertex> vertices_;
};

/// Did protection split the segment? Vertices that refinement gave it do not count.
inline bool is_split(std::span<const ChainVertex> chain) {
  return std::ranges::any_of(chain, [](const ChainVertex& v) { return v.level > 0; });
}

/// How many segments did protection split?
std::size_t count_split(const SegmentChains& chains);

}  // namespace ccdt::protection
