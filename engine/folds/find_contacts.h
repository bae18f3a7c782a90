#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"

namespace ccdt::folds {

/// The facet of the input that a facet of the PLC is, or is a part of.
struct FacetOrigin {
  FacetId facet;  ///< of the input
  bool moved;     ///< its faces may be elsewhere than those of the input, by less than the tolerance
};

/// The moved faces, ascending, that share more than vertices and edges with a face from another facet of the input.
/// Exact. Since Delaunay faces never do, one of the two is missing in the tetrahedralization; since facets of the input
/// never do, one of the two is moved.
///
/// \param codes    of the faces, see `front::find_delaunay_faces`
/// \param origins  of the facets
std::vector<std::uint32_t> find_contacts(const facets::FacetMesh& facets, const delaunay::Delaunay& delaunay,
                                         std::span<const std::uint32_t> codes, const std::vector<FacetOrigin>& origins);

}  // namespace ccdt::folds
