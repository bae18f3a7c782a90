#pragma once

#include <cstdint>
#include <optional>

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/front/front_faces.h"

namespace ccdt {

/// Finds the vertex that makes the constrained Delaunay tetrahedron above a face (paper, section 5.1).
///
/// First the vertex with the emptiest sphere is found without regard to facets. If that is visible, no other can be
/// better, which is so nearly everywhere: one test of visibility. Otherwise every vertex that would be the best so far
/// is tested.
///
/// \tparam Locator  `GridLocator` or `OctreeLocator`, of all that may be near
/// \return  nothing if no vertex above the face can be seen from it
template <class Locator>
std::optional<std::uint32_t> find_apex(const Locator& locator, const FacetMesh& facets, const Delaunay& delaunay,
                                       const OrientedFace& face);

}  // namespace ccdt
