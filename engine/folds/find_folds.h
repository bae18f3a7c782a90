#pragma once

#include <cstdint>
#include <vector>

#include "engine/facets/facet_mesh.h"
#include "engine/plc/plc.h"
#include "engine/protection/protect_edges.h"

namespace ccdt::folds {

/// The edges of faces that protection does not know of. A *fold* is an edge within a bent facet at which two faces are
/// not coplanar. Like a segment, it is grazeable if a sector of the domain of 180 degrees or more is around it.
struct Folds {
  std::vector<protection::PieceEnds> edges;   ///< the Delaunay edges among the grazeable folds and `loose_segments`
  std::vector<std::uint32_t> loose_segments;  ///< grazeable with these faces, not Delaunay, and not protected
  /// The faces at grazeable folds that are not Delaunay, and at folds along a segment of another facet; ascending.
  std::vector<std::uint32_t> loose_faces;

  bool are_protected() const { return loose_segments.empty() && loose_faces.empty(); }
};

/// \param facets  the triangulation of the facets with all vertices of the surface
Folds find_folds(const plc::Plc& plc, const protection::ProtectedDelaunay& surface, const facets::FacetMesh& facets);

/// Is an edge between two faces of a facet grazeable?
///
/// \param turn  the sign of `orient3d` of one face and the apex of the other: positive if they bend up
bool is_grazeable_fold(const plc::Plc& plc, const plc::Facet& facet, int turn);

}  // namespace ccdt::folds
