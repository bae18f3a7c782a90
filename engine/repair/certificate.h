#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/plc/build_plc.h"

namespace ccdt::repair {

using Corners = std::array<Point3, 3>;

/// What fills a hole.
struct Lid {
  std::vector<Corners> triangles;  ///< in grid units
  double reach = 0;                ///< the largest distance of its points from the rim; an upper bound; see `reach_of`
};

/// How far points of a lid are from its rim.
///
/// \param rim  the vertices around the hole
/// \param lid  not empty
/// \return  an upper bound of the largest distance, usually at most a tenth too large
double reach_of(std::span<const Corners> lid, std::span<const Point3> rim);

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

/// Compares a repaired surface with the given one.
///
/// The distance from a convex set is a convex function. So no point of a triangle is farther from a given triangle than
/// one of its corners is. The pieces of a given triangle cover it, so the bound holds in both directions.
///
/// \param given  before anything was done
Certificate certify(const plc::UncheckedPlc& given, const plc::UncheckedPlc& repaired, std::span<const Lid> lids);

}  // namespace ccdt::repair
