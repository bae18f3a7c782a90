#pragma once

#include "engine/facets/facet_mesh.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt {

/// Removes the tetrahedra of almost no volume that lie within a boundary facet, with all four vertices on it and two
/// faces on the boundary; their other two faces become the facet's. Only facets that are flat within the tolerance but
/// not exactly have such. A tetrahedron whose removal would take a vertex or a segment from its facet stays.
void peel_flat_tetrahedra(const Plc& plc, const SegmentChains& chains, FacetMesh& facets, TetMesh& mesh);

}  // namespace ccdt
