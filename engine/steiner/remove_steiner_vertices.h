#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/progress.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"
#include "engine/tets/cell_complex.h"

namespace ccdt::steiner {

using tets::CellComplex;

/// Removes Steiner vertices from segments wherever the space around them can be filled by positive tetrahedra without
/// them. The result is a mesh of the same PLC, but it need not be constrained Delaunay.
///
/// \param first_steiner  the least Steiner vertex
/// \param chains         lose the removed vertices
/// \return               how many were removed
std::uint64_t remove_steiner_vertices(const plc::Plc& plc, std::uint32_t first_steiner, CellComplex& complex,
                                      protection::SegmentChains& chains, const Progress& progress = {});

}  // namespace ccdt::steiner
