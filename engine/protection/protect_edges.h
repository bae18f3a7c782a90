#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/progress.h"
#include "engine/delaunay/delaunay.h"
#include "engine/plc/plc.h"
#include "engine/protection/options.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::protection {

/// A Delaunay tetrahedralization and the segments. Those that need protection are chains of its edges.
struct ProtectedDelaunay {
  delaunay::Delaunay delaunay;
  SegmentChains chains;
  std::vector<bool> must_be_chain;  ///< by segment: must its pieces be Delaunay edges?
};

/// The vertices at the ends of a piece of a segment, in the order of its chain.
using PieceEnds = std::array<std::uint32_t, 2>;

/// A segment cannot be protected.
class SegmentLimit : public LimitError {
 public:
  SegmentLimit(const std::array<VertexId, 2>& its_ends, const LimitError& error) : LimitError(error), ends(its_ends) {}
  std::array<VertexId, 2> ends;
};

/// The state before protection: the grazeable segments must still become chains of Delaunay edges.
///
/// \param delaunay  of the vertices of `plc` and of those inside the chains
/// \param chains    vertices that the first segments have already, the first ones after those of `plc`
ProtectedDelaunay unprotected(const plc::Plc& plc, delaunay::Delaunay delaunay, SegmentChains chains = {});

/// Splits every missing grazeable segment until each is a chain of Delaunay edges (paper, section 2), so that the
/// constrained Delaunay tetrahedralization exists (Shewchuk 2002).
///
/// `midpoint` bisects. `shell` splits at the foot of the vertex that encroaches most, so that one split is enough for
/// one vertex. If that vertex is on a segment that meets this one, it splits at the same distance from the common end:
/// the pieces of all segments there end on common spheres, and cannot split each other forever (Ruppert 1995; Si and
/// Gaertner 2005). Pieces of segments that were split often are not split near their ends but at planes common to all
/// segments, so that parallel segments are split side by side. Split points are dyadic fractions of the segment, j /
/// 2^20, and lie on it exactly. `shell` uses finer fractions where necessary, if they are on the grid, as on segments
/// between round coordinates.
///
/// \param start     `unprotected`, or the state of an earlier call, with more vertices
/// \param to_split  pieces that are split first, whether they are edges or not; those that are too short stay
/// \return          the same with the Steiner vertices, whose ids follow the existing ones
/// \throw SegmentLimit  a segment would need a split that is not on the grid; carries the place
ProtectedDelaunay protect_edges(const plc::Plc& plc, ProtectedDelaunay start, Protection strategy,
                                const Progress& progress = {}, std::span<const PieceEnds> to_split = {});

/// How many vertices were put on segments at each level, from level 1; for `midpoint` that is the depth of the
/// bisection.
std::vector<std::uint64_t> count_splits_by_level(const SegmentChains& chains);

}  // namespace ccdt::protection
