#pragma once

#include <cstdint>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"

namespace ccdt::front {

/// The face protection check (paper, section 5.2): for every face of the PLC its code in the cell above it, if it is a
/// face of the Delaunay tetrahedralization; `no_neighbor` if it is undelaunay.
std::vector<std::uint32_t> find_delaunay_faces(const facets::FacetMesh& facets, const delaunay::Delaunay& delaunay);

}  // namespace ccdt::front
