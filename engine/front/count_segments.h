#pragma once

#include <cstdint>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/front/segment_counts.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::front {

/// Counts how the segments become part of the mesh. An edge of a Delaunay face is Delaunay; only the edges of other
/// faces are searched in the tetrahedralization.
///
/// \param chains  of the segments, after protection
/// \param codes   of `find_delaunay_faces`
SegmentCounts count_segments(const plc::Plc& plc, const protection::SegmentChains& chains,
                             const facets::FacetMesh& facets, const std::vector<std::uint32_t>& codes,
                             const delaunay::Delaunay& delaunay);

}  // namespace ccdt::front
