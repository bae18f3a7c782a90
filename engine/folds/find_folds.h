#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/facets/facet_mesh.h"
#include "engine/plc/plc.h"
#include "engine/protection/protect_edges.h"

namespace ccdt::folds {

/// What keeps the theorem from holding; all lists ascend. Protection knows nothing of folds: a *fold* is an edge within
/// a nearly flat facet where two faces are not coplanar. Like a segment, it is grazeable if the domain spans 180
/// degrees or more around it.
struct LooseFolds {
  std::vector<std::uint32_t> segments;  ///< grazeable with these faces, and not protected
  std::vector<std::uint32_t> faces;     ///< at grazeable folds that are not Delaunay
  std::vector<std::uint32_t> touching;  ///< faces at folds along a segment of another facet
};

/// \param delaunay  has all vertices of the facets
/// \param facets    their triangulation
/// \param codes     of its triangles, see `front::find_delaunay_faces`
LooseFolds find_loose_folds(const plc::Plc& plc, const delaunay::Delaunay& delaunay,
                            const protection::SegmentChains& chains, const facets::FacetMesh& facets,
                            std::span<const std::uint32_t> codes);

/// `LooseFolds::touching` alone, which is faster.
std::vector<std::uint32_t> find_touching_faces(const plc::Plc& plc, const delaunay::Delaunay& delaunay,
                                               const protection::SegmentChains& chains,
                                               const facets::FacetMesh& facets);

/// Is an edge between two faces of a facet grazeable?
///
/// \param turn  the sign of `orient3d` of one face and the apex of the other: positive if they bend up
bool is_grazeable_fold(const plc::Plc& plc, const plc::Facet& facet, int turn);

}  // namespace ccdt::folds
