#pragma once

#include <cstdint>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/plc/plc.h"

namespace ccdt::front {

/// `find_delaunay_faces` for the triangles of facets. The check of the input has already found most of them
/// (`Plc::faces`).
std::vector<std::uint32_t> find_facet_faces(const plc::Plc& plc, const facets::FacetMesh& facets,
                                            const delaunay::Delaunay& delaunay);

}  // namespace ccdt::front
