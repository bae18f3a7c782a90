#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"

namespace ccdt::front {

/// Exactly: the faces, ascending, at edges of the tetrahedra where a face passes through a tetrahedron: near their
/// common edge, it lies between two faces of the tetrahedron. That is possible only where a facet is not exactly flat.
///
/// \param tetrahedra  positively oriented
std::vector<std::uint32_t> find_cutting_faces(const facets::FacetMesh& facets, const delaunay::Delaunay& delaunay,
                                              std::span<const std::array<std::uint32_t, 4>> tetrahedra);

}  // namespace ccdt::front
