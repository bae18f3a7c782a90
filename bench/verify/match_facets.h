#pragma once

#include "bench/verify/patches.h"

namespace ccdt::verify {

/// A face of the mesh that stands for a part of an input facet. Sides are those of `piece`.
struct MatchedFace {
  std::uint32_t face, piece;
  std::uint32_t tet_above, tet_below;  ///< `none` where there is no tetrahedron
  std::uint32_t plane = none;          ///< in `FacetMatches::planes`, if the facet is flat and within the mesh
};

struct Plane {
  Point3 normal, point;
};

/// As what a piece is in the mesh.
enum class FoundAs : std::uint8_t { nothing, boundary_of_above, boundary_of_below, interior };

/// Which faces of the mesh stand for which facets of the input.
struct FacetMatches {
  std::vector<MatchedFace> faces;          ///< those with one plane together
  std::vector<Plane> planes;               ///< one an interior facet that is flat within the tolerance
  std::vector<FoundAs> found;              ///< of each piece
  std::vector<std::string> problem;        ///< of each piece: what was wrong with what looked like it
  std::vector<std::uint32_t> stray_faces;  ///< boundary faces that stand for nothing
  std::vector<bool> is_matched;            ///< of each face of the mesh
};

/// Matches the boundary of the mesh with facets first, then inner faces with the facets that are left.
/// \param chains    of the surface's edges
/// \param features  of the surface's edges, see `find_features`
FacetMatches match_facets(const Topology& topology, const Surface& surface, const Chains& chains,
                          const std::vector<bool>& features);

}  // namespace ccdt::verify
