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
TetMesh collect_tetrahedra(const Plc& plc, const FrontResult& front, const std::vector<RegionId>& region_of_cell,
                           const Delaunay& delaunay);

/// Makes the mesh whole but for its coordinates: takes the flat tetrahedra on its boundary off, gives it the faces of
/// the facets and the edges of the segments.
///
/// \return the facet of each of the mesh's faces
/// \throw FrontStuck  the tetrahedra do not fill the domain
std::vector<std::uint32_t> finish_mesh(const Plc& plc, const SegmentChains& chains, FacetMesh facets,
                                       const Delaunay& delaunay, TetMesh& mesh);

}  // namespace ccdt
