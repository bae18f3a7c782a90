#pragma once

#include "bench/verify/ray.h"

namespace ccdt::verification {

enum class Inside : std::uint8_t { no, yes, unknown };

/// The parts of space that the input's facets do not divide further, found from the input alone.
struct Regions {
  /// Region of each side of each piece: 2 * piece for above, 2 * piece + 1 for below. Region 0 reaches infinity.
  std::vector<std::uint32_t> of_side;
  std::vector<Inside> inside;                ///< of each region
  std::vector<std::vector<int>> attributes;  ///< of each region, of the region seeds in it
  std::vector<std::uint32_t> hole_seeds;     ///< of each region, how many are in it

  std::uint32_t count() const { return static_cast<std::uint32_t>(inside.size()); }
  bool touches_inside(std::uint32_t piece) const {
    return inside[of_side[2 * piece]] == Inside::yes || inside[of_side[2 * piece + 1]] == Inside::yes;
  }
};

/// Finds the regions: sides of pieces are glued around edges, and shells are put into each other by rays.
///
/// Which regions of a surface (`Inside::even_odd`) are inside is a matter of its shells: connected pieces. A region
/// is inside if an odd number of shells, or of pieces on the shortest way to infinity, is around it. Where the two
/// differ, which takes regions that share pieces and of which one is enclosed by others, either is right:
/// `Inside::unknown`.
Regions find_regions(const InputPlc& input, const Surface& surface);

/// The regions that a point is in, or borders on if it lies on the surface. Empty if the surface there is too crooked
/// to tell.
std::vector<std::uint32_t> regions_at(const Surface& surface, const Regions& regions, const RayShooter& rays,
                                      const Point3& point);

}  // namespace ccdt::verification
