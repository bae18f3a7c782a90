#pragma once

#include <optional>
#include <vector>

#include "engine/base/progress.h"
#include "engine/delaunay/delaunay.h"
#include "engine/folds/find_contacts.h"
#include "engine/plc/plc.h"
#include "engine/protection/protect_edges.h"

namespace ccdt::folds {

/// A surface whose vertices have a constrained Delaunay tetrahedralization, also with interior vertices that leave its
/// edges Delaunay.
struct ProtectedSurface {
  protection::ProtectedDelaunay delaunay;
  std::vector<protection::PieceEnds> folds;  ///< Delaunay edges that must stay, beside those along segments
  std::vector<FacetOrigin> origins;          ///< of the facets of the PLC, if any are bent
};

/// Protects the segments (`protection::protect_edges`) and establishes the invariant from which the rest follows: all
/// faces and segments form a PLC of flat facets, and all its grazeable edges are Delaunay. So there is a constrained
/// Delaunay tetrahedralization (Shewchuk 2002), and the front cannot get stuck.
///
/// For exactly flat facets nothing remains to be done. A bent facet, one that is flat only within the tolerance, is not
/// one facet of that PLC: each of its faces is. Then the folds between them must be Delaunay if they are grazeable, and
/// no face may meet another facet, of which it may have been less than the tolerance away. Facets for which that is not
/// so are divided (`FacetDivider`), and all starts again from the vertices. This ends, because each time a facet is
/// divided further, and the triangles of the input have no folds and meet nothing.
///
/// \param plc         gets the segments and facets of the divisions
/// \param delaunay    of the vertices of `plc` and of those inside the chains
/// \param chains      see `protection::unprotected`
/// \param tolerance   of flatness, in grid units
/// \throw LimitError  a segment cannot be protected, however the facets around it are divided
ProtectedSurface protect_facets(plc::Plc& plc, delaunay::Delaunay delaunay, protection::SegmentChains chains,
                                double tolerance, protection::Protection strategy, const Progress& progress = {});

/// The folds that must stay once segments of a protected surface were split further.
///
/// \param before  the surface before that
/// \return        none if facets would have to be divided
std::optional<std::vector<protection::PieceEnds>> folds_after_splits(const plc::Plc& plc,
                                                                     const protection::ProtectedDelaunay& surface,
                                                                     const ProtectedSurface& before);

}  // namespace ccdt::folds
