#include "engine/folds/protect_facets.h"

#include <algorithm>
#include <utility>

#include "engine/folds/divide_facets.h"
#include "engine/folds/find_folds.h"

namespace ccdt::folds {
namespace {

using protection::ProtectedDelaunay;

/// Protects the segments of the PLC, in which divisions that do not allow that are given up.
ProtectedDelaunay protect_segments(plc::Plc& plc, FacetDivider& divider, const delaunay::Delaunay& delaunay,
                                   const protection::SegmentChains& chains, protection::Protection strategy,
                                   const Progress& progress) {
  for (;;) {
    try {
      return protection::protect_edges(plc, protection::unprotected(plc, delaunay, chains), strategy, progress);
    } catch (const protection::SegmentLimit& limit) {
      if (!divider.give_way(limit.ends)) throw;
      plc = divider.divided();
    }
  }
}

}  // namespace

ProtectedSurface protect_facets(plc::Plc& plc, delaunay::Delaunay delaunay, protection::SegmentChains chains,
                                double tolerance, protection::Protection strategy, const Progress& progress) {
  if (std::ranges::all_of(plc.facets, &plc::Facet::exactly_flat)) {
    ProtectedDelaunay start = protection::unprotected(plc, std::move(delaunay), std::move(chains));
    return {protection::protect_edges(plc, std::move(start), strategy, progress), {}, {}};
  }
  const plc::Plc undivided = plc;
  FacetDivider divider(undivided, delaunay, tolerance);
  for (;; plc = divider.divided()) {
    ProtectedDelaunay surface = protect_segments(plc, divider, delaunay, chains, strategy, progress);
    const facets::FacetMesh faces = facets::triangulate_facets(plc, surface.chains, surface.delaunay, progress);
    std::vector<FacetOrigin> origins = divider.origins();
    Folds folds = find_folds(plc, surface, faces);
    divider.make_grazeable(plc, folds.loose_segments);
    divider.divide(faces, folds.loose_faces, origins, surface.delaunay);
    if (!folds.are_protected()) continue;
    const std::vector<std::uint32_t> contacts = find_contacts(faces, surface.delaunay, origins);
    if (contacts.empty()) return {std::move(surface), std::move(folds.edges), std::move(origins)};
    divider.follow_input(faces, contacts, origins);
  }
}

std::optional<std::vector<protection::PieceEnds>> folds_after_splits(const plc::Plc& plc,
                                                                     const ProtectedDelaunay& surface,
                                                                     const ProtectedSurface& before) {
  if (before.origins.empty()) return before.folds;
  const facets::FacetMesh faces = facets::triangulate_facets(plc, surface.chains, surface.delaunay);
  Folds folds = find_folds(plc, surface, faces);
  if (!folds.are_protected() || !find_contacts(faces, surface.delaunay, before.origins).empty()) return std::nullopt;
  return std::move(folds.edges);
}

}  // namespace ccdt::folds
