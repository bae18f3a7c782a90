#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"

namespace ccdt::front {

/// Finds tetrahedra that contain a vertex that is not a corner of any of them or of any face of the PLC. Such a vertex
/// was overlooked: the tetrahedra fit each other, but they are constrained Delaunay only for the other vertices.
///
/// \param tetrahedra  positively oriented; those with `ghost_vertex` are skipped
/// \return            their indices, ascending; touching counts as containing
std::vector<std::uint32_t> find_swallowing(std::span<const std::array<std::uint32_t, 4>> tetrahedra,
                                           const facets::FacetMesh& facets, const delaunay::Delaunay& delaunay);

}  // namespace ccdt::front
