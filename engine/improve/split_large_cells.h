#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/progress.h"
#include "engine/plc/plc.h"
#include "engine/tets/cell_complex.h"

namespace ccdt::improve {

/// The largest volume of the cells with a region attribute, in cubic grid units.
struct VolumeLimit {
  int attribute;
  double volume;
};

/// The limits of a domain's regions.
///
/// \param has_attributes  does the mesh have the attribute of each cell? If not, it is 0 for all
std::vector<VolumeLimit> volume_limits(const plc::Plc& plc, bool has_attributes);

/// Inserts vertices into cells that are larger than their limit until there are none.
///
/// \param complex     the mesh
/// \param limits      of its regions
/// \param most_share  nothing happens if a larger share of the cells is too large
/// \param progress    of the stage "improve"
/// \return            how many vertices were inserted
/// \throw LimitError  a cell is too flat to be divided
std::uint64_t split_large_cells(tets::CellComplex& complex, const std::vector<VolumeLimit>& limits, double most_share,
                                const Progress& progress);

}  // namespace ccdt::improve
