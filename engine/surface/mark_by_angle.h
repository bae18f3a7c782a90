#pragma once

#include <array>

#include "engine/base/enum_names.h"
#include "engine/base/flatness.h"
#include "engine/plc/input.h"
#include "engine/surface/options.h"

namespace ccdt::surface {

/// Where the markers of facets come from.
enum class MarkerSource { file, by_angle };

constexpr auto names_of(MarkerSource) {
  return std::to_array<NamedValue<MarkerSource>>(
      {{MarkerSource::file, "file", "those of the file, if it has any"},
       {MarkerSource::by_angle, "by-angle", "one for each set of facets that sharp edges bound"}});
}

/// Gives one marker to all facets that are connected across edges that are not sharp. Edges with one facet or more than
/// two, where regions meet, and segments of the input count as sharp. The markers are numbered from 1, in the order of
/// the first facet of each. Facets without area get the marker 0.
///
/// The input need not be valid, but its polygons must be.
///
/// \param sharp_angle  see RemeshOptions, as for the flatness
/// \return             how many markers there are
/// \throw InputError   the facets have several markers already; or as `plc::gather_plc`
int mark_by_angle(plc::InputPlc& input, double sharp_angle = usual_sharp_angle, double flatness = usual_flatness);

}  // namespace ccdt::surface
