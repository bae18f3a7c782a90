#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/raw_vector.h"
#include "engine/delaunay/delaunay.h"
#include "engine/front/advance_front.h"
#include "engine/front/stuck.h"

namespace ccdt::label {

/// Which cells belong to the domain.
struct CellLabels {
  RawVector<RegionId> regions;  ///< by cell; none for cells outside and for those that the front has replaced
  /// Parts of different regions are connected: front and tetrahedralization do not fit. There are no regions then.
  std::optional<front::Stuck> stuck = {};
};

/// Labels the Delaunay cells of the domain with their region (paper, section 5.2, step 5): all that are connected to
/// the open faces of the front, on the upper side, without crossing a face of the front or of the PLC. Holes, regions
/// and slits need no special treatment: they follow from the regions on the sides of the facets.
///
/// \param wall_codes  the Delaunay faces of the PLC, as the cell above calls them; `no_neighbor` entries are skipped
CellLabels label_cells(const plc::Plc& plc, const delaunay::Delaunay& delaunay,
                       const std::vector<front::FrontFace>& open, const std::vector<std::uint32_t>& wall_codes);

}  // namespace ccdt::label
