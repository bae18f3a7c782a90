#pragma once

#include <optional>
#include <span>

#include "engine/base/progress.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/folds/divide_facets.h"
#include "engine/plc/plc.h"
#include "engine/protection/protect_edges.h"

namespace ccdt::folds {

/// Establishes the invariant from which the rest follows: all faces and segments form a PLC of flat facets, and all its
/// grazeable edges are Delaunay. So there is a constrained Delaunay tetrahedralization (Shewchuk 2002), and the front
/// cannot get stuck.
///
/// For exactly flat facets it is enough to protect the segments (`protection::protect_edges`). A bent facet, one that
/// is flat only within the tolerance, is not one facet of that PLC: each of its faces is. Then the folds between them
/// must be Delaunay if they are grazeable, and no face may meet another facet, of which it may have been less than the
/// tolerance away. Facets for which that is not so are divided (`FacetDivider`), and all starts again from the vertices
/// of the PLC. This ends, because each time a facet is divided further, and the triangles of the input have no folds
/// and meet nothing.
///
/// Where a division cannot be protected, as at the tip of a wedge, the facet is given up: its folds are not protected.
/// The front may get stuck there, although we know no input where it does.
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

  /// A surface for whose vertices the invariant holds.
  ///
  /// \throw LimitError  a segment cannot be protected, however the facets around it are divided
  protection::ProtectedDelaunay protect(const Progress& progress = {});

  /// Does the invariant hold with all vertices? If not, facets have been divided, and `protect` must be called again.
  ///
  /// \param delaunay  of all vertices
  /// \param faces     of the facets
  /// \param codes     of the faces, see `front::find_delaunay_faces`
  bool holds(const delaunay::Delaunay& delaunay, const protection::SegmentChains& chains,
             const facets::FacetMesh& faces, std::span<const std::uint32_t> codes);

 private:
  protection::ProtectedDelaunay protect_segments(const Progress& progress);

  plc::Plc& plc_;
  delaunay::Delaunay delaunay_;  // these two are moved from if no facet is bent
  protection::SegmentChains chains_;
  protection::Protection strategy_;
  plc::Plc undivided_;                   // if any facet is bent
  std::optional<FacetDivider> divider_;  // of `undivided_`
};

}  // namespace ccdt::folds
