#pragma once

#include <cstdint>

namespace ccdt::front {

/// How the segments of a PLC became part of the mesh: each is a Delaunay edge, was split, or was made by the front. A
/// segment that refinement divided counts once; it is a Delaunay edge if all its parts are.
struct SegmentCounts {
  std::uint64_t all = 0;        ///< edges where facets meet or end, and segments of the input
  std::uint64_t grazeable = 0;  ///< those that must be chains of Delaunay edges
  std::uint64_t delaunay = 0;   ///< Delaunay edges without a split
  std::uint64_t split = 0;      ///< split by protection
  std::uint64_t pieces = 0;     ///< the Delaunay edges of split segments
  std::uint64_t restored = 0;   ///< split, but one edge again because the vertices on it were removed
  std::uint64_t front = 0;  ///< not Delaunay edges but not split, because they are not grazeable: the front makes them
};

}  // namespace ccdt::front
