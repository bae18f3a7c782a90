#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/raw_vector.h"
#include "engine/delaunay/delaunay.h"
#include "engine/front/advance_front.h"

namespace ccdt::label {

/// Which cells belong to the domain. Labels the Delaunay cells of the domain with their region (paper, section 5.2,
/// step 5): all cells connected to the upper side of the front's open faces without crossing a face of the front or of
/// the PLC. Holes, regions and slits need no special treatment: they follow from the regions on the sides of the
/// facets.
///
/// \param wall_codes  codes of the Delaunay faces of the PLC in the cells above; `no_neighbor` entries are skipped
/// \return            by cell; none for cells outside and for those that the front has replaced
/// \throw MeshError   parts of different regions are connected: front and tetrahedralization do not match
RawVector<RegionId> label_cells(const plc::Plc& plc, const delaunay::Delaunay& delaunay,
                                const std::vector<front::FrontFace>& open,
                                const std::vector<std::uint32_t>& wall_codes);

}  // namespace ccdt::label
