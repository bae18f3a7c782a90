#include "engine/folds/protect_facets.h"

#include <algorithm>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/errors.h"
#include "engine/folds/find_contacts.h"
#include "engine/folds/find_folds.h"
#include "engine/front/find_delaunay_faces.h"

namespace ccdt::folds {

using protection::ProtectedDelaunay;

SurfaceProtector::SurfaceProtector(plc::Plc& plc, delaunay::Delaunay delaunay, protection::SegmentChains chains,
                                   double tolerance, protection::Protection strategy)
    : plc_(plc),
      delaunay_(std::move(delaunay)),
      chains_(std::move(chains)),
      tolerance_(tolerance),
      strategy_(strategy),
      has_nearly_flat_facets_(std::ranges::find(plc.facets, false, &plc::Facet::exactly_flat) != plc.facets.end()) {}

/// Gives up divisions that keep segments from being protected.
ProtectedDelaunay SurfaceProtector::protect_segments(const Progress& progress) {
  for (;;) {
    try {
      return protection::protect_edges(plc_, protection::unprotected(plc_, delaunay_, chains_), strategy_, progress);
    } catch (const protection::SegmentLimit& limit) {
      if (!divider_ || !divider_->give_way(limit.ends)) throw;
      plc_ = divider_->divided();
    }
  }
}

ProtectedDelaunay SurfaceProtector::protect(const Progress& progress) {
  if (!has_nearly_flat_facets_) {
    ProtectedDelaunay start = protection::unprotected(plc_, std::move(delaunay_), std::move(chains_));
    return protection::protect_edges(plc_, std::move(start), strategy_, progress);
  }
  for (;;) {
    ProtectedDelaunay surface = protect_segments(progress);
    if (!divider_) return surface;
    const facets::FacetMesh faces = facets::triangulate_facets(plc_, surface.chains, surface.delaunay, progress);
    const auto codes = front::find_delaunay_faces(faces.triangles, surface.delaunay);
    if (is_protected(surface.delaunay, surface.chains, faces, codes)) return surface;
  }
}

bool SurfaceProtector::protect_folds() {
  if (!has_nearly_flat_facets_ || divider_) return false;
  undivided_ = plc_;
  divider_.emplace(undivided_, delaunay_, tolerance_);
  return true;
}

/// Do faces of nearly flat facets meet no other facets?
bool SurfaceProtector::are_apart(const delaunay::Delaunay& delaunay, const protection::SegmentChains& chains,
                                 const facets::FacetMesh& faces, std::span<const std::uint32_t> codes) const {
  std::vector<FacetOrigin> origins;
  for (std::uint32_t f = 0; f < plc_.facets.size(); ++f) origins.push_back({FacetId(f), !plc_.facets[f].exactly_flat});
  return find_touching_faces(plc_, delaunay, chains, faces).empty() &&
         find_contacts(faces, delaunay, codes, origins).empty();
}

bool SurfaceProtector::is_protected(const delaunay::Delaunay& delaunay, const protection::SegmentChains& chains,
                                    const facets::FacetMesh& faces, std::span<const std::uint32_t> codes) {
  if (!has_nearly_flat_facets_) return true;
  if (!divider_) {
    if (are_apart(delaunay, chains, faces, codes)) return true;
    throw MeshError("facets that are flat only within the tolerance meet", {.file = plc_.name},
                    "another --flatness may help");
  }
  const std::vector<FacetOrigin> origins = divider_->origins();
  const LooseFolds loose = find_loose_folds(plc_, delaunay, chains, faces, codes);
  divider_->make_grazeable(plc_, loose.segments);
  divider_->divide(faces, loose.faces, origins, delaunay);
  divider_->follow_input(faces, loose.touching, origins);
  bool is_protected = loose.segments.empty() && loose.faces.empty() && loose.touching.empty();
  if (is_protected) {
    const std::vector<std::uint32_t> contacts = find_contacts(faces, delaunay, codes, origins);
    divider_->follow_input(faces, contacts, origins);
    is_protected = contacts.empty();
  }
  if (is_protected) return true;
  ++work_done.fold_rounds;
  plc_ = divider_->divided();
  return false;
}

}  // namespace ccdt::folds
