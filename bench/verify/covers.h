#pragma once

#include "bench/verify/patches.h"
#include "bench/verify/regions.h"

namespace ccdt::verification {

/// A face of the mesh that stands for a part of an input facet. Sides are those of `piece`.
struct CoverFace {
  std::uint32_t face, piece;
  std::uint32_t tet_above, tet_below;  ///< `none` where there is no tetrahedron
  std::uint32_t plane = none;          ///< in `Covers::planes`, if it covers an interior facet that is flat
};

struct Plane {
  Point3 normal, point;
};

enum class Found : std::uint8_t { nothing, boundary_of_above, boundary_of_below, interior };

/// Which faces of the mesh stand for which facets of the input.
struct Covers {
  std::vector<CoverFace> faces;            ///< those with one plane together
  std::vector<Plane> planes;               ///< one an interior facet that is flat within the tolerance
  std::vector<Found> found;                ///< of each piece
  std::vector<std::string> problem;        ///< of each piece: what was wrong with what looked like it
  std::vector<std::uint32_t> stray_faces;  ///< boundary faces that stand for nothing
  std::vector<bool> covers;                ///< of each face of the mesh
};

/// Is the edge one that a mesh must have: not between two facets in one plane with one marker?
std::vector<bool> find_features(const Surface& surface);

Covers find_covers(const TetMesh& mesh, const Topology& topology, const Surface& surface, const Chains& chains,
                   const std::vector<bool>& features);

/// \name Parts of `find_covers`, one a file.
/// @{
void cover_boundary(const TetMesh& mesh, const Topology& topology, const Surface& surface, const Chains& chains,
                    Covers& covers);
void cover_interior(const TetMesh& mesh, const Topology& topology, const Surface& surface, const Chains& chains,
                    const std::vector<bool>& features, Covers& covers);
/// @}

}  // namespace ccdt::verification
