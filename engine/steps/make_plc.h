#pragma once

#include "engine/delaunay/delaunay.h"
#include "engine/plc/input.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"
#include "engine/steps/run.h"

namespace ccdt::steps {

/// A valid PLC, and the Delaunay tetrahedralization of its vertices and those on its segments.
struct TetrahedralizedPlc {
  plc::Plc plc;
  protection::SegmentChains chains = {};  ///< with the vertices of refinement; see `protection::unprotected`
  delaunay::Delaunay delaunay = {};
};

/// Puts an input on the grid, checks it, and refines its surface if requested.
///
/// \param flattens    before refinement, nearly flat facets are divided into the triangles of the input, so all are
///                    exactly flat
/// \throw InputError  the input is not a valid PLC
TetrahedralizedPlc make_plc(const InputPlc& input, bool flattens, Run& run);

}  // namespace ccdt::steps
