#pragma once

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/front/advance_front.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt {

/// The tetrahedra of the front and the labelled cells, with their regions: the constrained Delaunay tetrahedralization.
/// The mesh has nothing else yet.
TetMesh collect_tetrahedra(const Plc& plc, const FrontResult& front, const std::vector<ChamberId>& chamber_of_cell,
                           const Delaunay& delaunay);

/// Makes the mesh whole: takes the flat tetrahedra on its boundary off, gives it the faces of the facets, the edges of
/// the segments, and the vertices in the units of the input.
///
/// \throw FrontStuck  the tetrahedra do not fill the domain
/// \throw MeshError   of `to_world`
void finish_mesh(const Plc& plc, const SegmentChains& chains, FacetMesh facets, const Delaunay& delaunay,
                 TetMesh& mesh);

}  // namespace ccdt
