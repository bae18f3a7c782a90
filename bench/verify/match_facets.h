#pragma once

#include "bench/verify/patches.h"

namespace ccdt::verify {

/// A face of the mesh on an input facet. Sides are those of `piece`.
struct MatchedFace {
  std::uint32_t face, piece;
  std::uint32_t tet_above, tet_below;  ///< `none` if there is no tetrahedron
  std::uint32_t plane = none;          ///< in `FacetMatches::planes`, if the facet is flat and within the mesh
};

struct Plane {
  Point3 normal, point;
};

/// How a piece occurs in the mesh.
enum class FoundAs : std::uint8_t { nothing, boundary_of_above, boundary_of_below, interior };

/// The assignment of faces of the mesh to facets of the input.
struct FacetMatches {
  std::vector<MatchedFace> faces;          ///< grouped by plane
  std::vector<Plane> planes;               ///< one for each interior facet that is flat within the tolerance
  std::vector<FoundAs> found;              ///< for each piece
  std::vector<std::string> problem;        ///< for each piece: the error of a similar part of the mesh
  std::vector<std::uint32_t> stray_faces;  ///< boundary faces without a facet
  std::vector<bool> is_matched;            ///< for each face of the mesh
};

/// Matches the boundary of the mesh with facets first, then inner faces with the remaining facets.
/// \param chains    the chains of the surface's edges
/// \param features  for each edge of the surface, see `find_features`
FacetMatches match_facets(const Topology& topology, const Surface& surface, const Chains& chains,
                          const std::vector<bool>& features);

}  // namespace ccdt::verify
