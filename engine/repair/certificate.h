#pragma once

#include <cstdint>
#include <optional>

namespace ccdt::repair {

/// How a repaired surface differs from what was given. Lengths and areas are in units of the input.
struct Certificate {
  /// No point of the repaired surface, lids apart, is farther from the given surface, and no point of the given
  /// surface, apart from what was removed, is farther from the repaired one. An upper bound.
  double displacement = 0;
  double area_before = 0, area_after = 0;
  double area_of_lids = 0;
  double area_removed = 0;              ///< duplicates, flaps, loose sheets, and walls inside a union
  double largest_lid = 0;               ///< its area
  double farthest_lid = 0;              ///< the largest distance of a lid from its rim; see `Lid`
  std::optional<double> volume_before;  ///< of a given surface without open edges, by its own orientation
  std::uint64_t components_before = 0, components_after = 0;  ///< parts connected by edges
  std::optional<std::int64_t> genus;                          ///< of the repaired surface if it is a closed manifold
};

}  // namespace ccdt::repair
