#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/errors.h"
#include "engine/plc/build_plc.h"
#include "engine/plc/input.h"
#include "engine/plc/options.h"

namespace ccdt::repair {

/// An input as triangles, without facets that cannot be triangles.
struct Soup {
  plc::InputPlc input;                  ///< without invalid polygons; warped ones are triangles
  plc::UncheckedPlc parts;              ///< the triangles that have an area, and the segments
  std::vector<Place> invalid_polygons;  ///< the facets that were left out, because they are not polygons in one plane
  std::vector<std::uint32_t> without_area;  ///< the numbers of facets that were left out, because they have no area
};

/// Makes triangles of an input, whatever else is wrong with it.
///
/// \throw InputError  coordinates that are not finite; no facet has an area
Soup gather_soup(const plc::InputPlc& given, const plc::PlcOptions& options = {});

}  // namespace ccdt::repair
