#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/progress.h"
#include "engine/facets/facet_mesh.h"
#include "engine/plc/facet_part.h"
#include "engine/plc/plc.h"
#include "engine/plc/strict_places.h"
#include "engine/protection/protect_edges.h"

namespace ccdt::retry {

/// A piece of a segment, by its place: ids of segments and Steiner vertices differ between two attempts.
struct PieceToSplit {
  std::array<VertexId, 2> segment;  ///< its ends
  std::uint32_t from, to;           ///< fractions of the segment; see `protection::ChainVertex`

  friend auto operator<=>(const PieceToSplit&, const PieceToSplit&) = default;
};

/// What the next attempt does differently, so that the vertices have a constrained Delaunay tetrahedralization where
/// facets are flat only within the tolerance.
struct Remedies {
  std::vector<std::vector<PieceToSplit>> splits;  ///< one list after the other
  std::vector<plc::FacetPart> divided;            ///< see `divide_facets`
  bool last_is_split = false;                     ///< the last remedy is the last list of splits
  bool follow_input = false;                      ///< facets are divided along the triangles of the input instead
  plc::Strictness strictness;                     ///< which ones
  std::size_t fewest_faces = std::numeric_limits<std::size_t>::max();  ///< near the places where an attempt failed
  int count = 0;                                                       ///< of remedies so far
};

/// An attempt that failed.
struct FailedAttempt {
  const plc::Plc& plc;
  const protection::SegmentChains& chains;
  const facets::FacetMesh& facets;
  std::span<const Point3> points;        ///< of the vertices, in grid units
  std::span<const std::uint32_t> faces;  ///< `front::Stuck`
};

/// Adds a remedy. As long as it helps, the segments at long faces are split: a shorter face bends less. Otherwise, the
/// facets there are divided: exactly flat ones have no such places (Shewchuk 2002). They are divided along Delaunay
/// triangles, because those of the input may be needles that nothing can protect. If that does not help, the triangles
/// of the input are followed: facets become flatter, and if ever more places turn up, everywhere.
///
/// \return  false if there is none left
bool add_remedy(const FailedAttempt& attempt, Remedies& remedies);

/// Gives up the last remedy, with which segments cannot be protected. Splits are taken back, because they would be in
/// the way of all later remedies. The triangles of the input are followed next.
///
/// \return  false if the last remedy was to follow them
bool replace_remedy(Remedies& remedies);

/// Protects the segments again after each round of splits.
protection::ProtectedDelaunay split_pieces(const plc::Plc& plc, protection::ProtectedDelaunay surface,
                                           const Remedies& remedies, protection::Protection strategy,
                                           const Progress& progress = {});

}  // namespace ccdt::retry
