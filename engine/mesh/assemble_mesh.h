#pragma once

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/front/advance_front.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt {

/// Puts the tetrahedra of the front and the labelled cells together to one mesh, in the units of the input, less the
/// flat ones on its boundary.
///
/// \throw FrontStuck  the tetrahedra do not fill the domain
/// \throw MeshError   of `to_world`
TetMesh assemble_mesh(const Plc& plc, const SegmentChains& chains, FacetMesh facets, const FrontResult& front,
                      const std::vector<ChamberId>& chamber_of_cell, const Delaunay& delaunay);

}  // namespace ccdt
