#pragma once

#include <cstdint>
#include <vector>

#include "engine/facets/facet_mesh.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::facets {

/// The faces, ascending, with which a facet that is flat only within the tolerance touches what it must not touch: an
/// edge of the face is on a segment that is not part of the facet, or another facet has the same face. A mesh with such
/// faces would be pinched there.
///
/// \param vertices  their number, those on segments included
std::vector<std::uint32_t> find_touching_faces(const plc::Plc& plc, const protection::SegmentChains& chains,
                                               const FacetMesh& facets, std::size_t vertices);

}  // namespace ccdt::facets
