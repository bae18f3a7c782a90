#pragma once

#include <optional>
#include <span>
#include <utility>

#include "engine/base/progress.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/folds/divide_facets.h"
#include "engine/plc/plc.h"
#include "engine/protection/protect_edges.h"

namespace ccdt::folds {

/// Protects a surface until it has a constrained Delaunay tetrahedralization.
///
/// For exactly flat facets it is enough to protect the segments (`protection::protect_edges`; Shewchuk 2002). A facet
/// that is only nearly flat is not one facet in the sense of that theorem, but each of its faces is. So *folds*, the
/// edges between these faces, must be Delaunay, too, if they are grazeable. And no face may meet another facet, which
/// may be closer than the tolerance. Where this fails, facets are divided (`FacetDivider`), and protection starts again
/// from the vertices of the PLC. This ends: each time a facet is divided further, and the triangles of the input have
/// no folds and meet nothing.
///
/// Hardly any surface needs its folds, and some cannot have them: where vertices on both sides of a wedge are close to
/// each other, protection would never end. So folds are protected only after the front has got stuck without that, or
/// if faces meet.
class SurfaceProtector {
 public:
  /// \param plc        gets the segments and facets of the divisions; must outlive this
  /// \param delaunay   of the vertices of `plc` and of those inside the chains
  /// \param chains     see `protection::unprotected`
  /// \param tolerance  of flatness, in grid units
  SurfaceProtector(plc::Plc& plc, delaunay::Delaunay delaunay, protection::SegmentChains chains, double tolerance,
                   protection::Protection strategy);
  SurfaceProtector(const SurfaceProtector&) = delete;  // a member refers to another one
  SurfaceProtector& operator=(const SurfaceProtector&) = delete;

  /// A surface whose segments are protected, and its folds after `protect_folds`.
  ///
  /// \throw LimitError  a segment cannot be protected, however the facets around it are divided
  protection::ProtectedDelaunay protect(const Progress& progress = {});

  /// From now on, folds are protected, too; `protect` must be called again.
  ///
  /// \return  false if nothing changes
  bool protect_folds();

  /// The PLC without divisions.
  const plc::Plc& undivided() const { return divider_ ? undivided_ : plc_; }

  /// Starts again with more vertices in the chains; `protect` must be called again.
  ///
  /// \param delaunay, chains  as for the constructor, of `undivided`
  void restart(delaunay::Delaunay delaunay, protection::SegmentChains chains) {
    delaunay_ = std::move(delaunay);
    chains_ = std::move(chains);
  }

  /// Is the surface protected with all vertices? If not, facets have been divided, and `protect` must be called again.
  ///
  /// \param delaunay  of all vertices
  /// \param faces     of the facets
  /// \param codes     of the faces, see `front::find_delaunay_faces`
  /// \throw MeshError  faces meet, and folds are not protected
  bool is_protected(const delaunay::Delaunay& delaunay, const protection::SegmentChains& chains,
                    const facets::FacetMesh& faces, std::span<const std::uint32_t> codes);

 private:
  protection::ProtectedDelaunay protect_segments(const Progress& progress);
  bool are_apart(const delaunay::Delaunay& delaunay, const protection::SegmentChains& chains,
                 const facets::FacetMesh& faces, std::span<const std::uint32_t> codes) const;

  plc::Plc& plc_;
  delaunay::Delaunay delaunay_;  // these two are moved from if all facets are exactly flat
  protection::SegmentChains chains_;
  double tolerance_;
  protection::Protection strategy_;
  bool has_nearly_flat_facets_;
  plc::Plc undivided_;                   // these two are used once folds are protected
  std::optional<FacetDivider> divider_;  // of `undivided_`
};

}  // namespace ccdt::folds
