#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/base/flatness.h"
#include "engine/base/progress.h"
#include "engine/plc/input.h"

namespace ccdt::repair {

struct RepairOptions {
  double flatness = usual_flatness;  ///< tolerance for flat facets, as in the mesher
  double gap = 0;  ///< the widest gap to close, in the units of the input; 0: `usual_gap` of the largest extent
};

/// As a fraction of the largest extent.
inline constexpr double usual_gap = 1e-4;

/// Something that was done to an input.
struct RepairStep {
  std::string_view name;  ///< for JSON
  std::string_view what;  ///< what was counted
  std::uint64_t count;
};

struct Repaired {
  plc::InputPlc input;            ///< triangles only, without unused vertices of a surface; it may still have faults
  std::vector<RepairStep> steps;  ///< those that did something, in their order
};

/// Repairs an input as far as possible without knowing what was meant.
///
/// Removes facets without area, facets that are not polygons, and duplicates. In a surface, it closes gaps between open
/// edges, removes flaps that bound nothing, fills holes, and turns facets so that their normals point out of the
/// domain. Facets that cross are cut at their intersections; where closed surfaces overlap, their union is left.
/// Vertices keep their places, except where gaps are closed or where facets almost touch.
///
/// \throw InputError  coordinates that are not finite; no facet has an area, or none is left
Repaired repair_input(const plc::InputPlc& input, const RepairOptions& options = {}, const Progress& progress = {});

}  // namespace ccdt::repair
