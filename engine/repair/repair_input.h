#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/flatness.h"
#include "engine/base/progress.h"
#include "engine/plc/input.h"
#include "engine/repair/certificate.h"

namespace ccdt::repair {

struct RepairOptions {
  double flatness = usual_flatness;  ///< tolerance for flat facets, as in the mesher
  double gap = 0;      ///< the widest gap to close, in the units of the input; 0: `usual_gap` of the largest extent
  double limit = 0;    ///< how far lids may reach from their rims, and everything else may move, in the units of the
                       ///< input; 0: `usual_reach` and `usual_displacement` of the largest extent
  double seconds = 0;  ///< after this time no further step is begun; 0: `usual_seconds`
};

/// As fractions of the largest extent.
inline constexpr double usual_gap = 1e-4, usual_reach = 1e-3, usual_displacement = 1e-6;

/// In proportion to the input.
double usual_seconds(std::size_t facets);

/// Something that was done to an input.
struct RepairStep {
  std::string_view name;  ///< for JSON
  std::string_view what;  ///< what was counted
  std::uint64_t count = 0;
  std::vector<Place> places = {};  ///< of the first ones: points in the units of the input, numbers of facets
};

struct Repaired {
  plc::InputPlc input;            ///< triangles only, without unused vertices of a surface; it may still have faults
  std::vector<RepairStep> steps;  ///< those that did something, in their order
  Certificate certificate;
  /// What the limits forbade, and which option allows it; empty if nothing. Then `input` is not what was asked for.
  std::vector<std::string> refused = {};
  bool is_out_of_time = false;
};

/// Repairs an input as far as possible without knowing what was meant.
///
/// Removes facets without area, facets that are not polygons, and duplicates. In a surface, it closes gaps between open
/// edges, removes flaps that bound nothing, fills small holes, removes small sheets beside closed parts, and turns
/// facets so that their normals point out of the domain. Facets that cross are cut at their intersections; where closed
/// surfaces overlap, their union is left. Vertices keep their places, except where gaps are closed or where facets
/// almost touch; where such facets cannot be cut cleanly, all vertices are rounded to a coarser grid.
///
/// \throw InputError  coordinates that are not finite; no facet has an area, or none encloses anything; an index or an
///                    option is out of range
Repaired repair_input(const plc::InputPlc& input, const RepairOptions& options = {}, const Progress& progress = {});

}  // namespace ccdt::repair
