#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/base/progress.h"
#include "engine/delaunay/delaunay.h"
#include "engine/plc/plc.h"
#include "engine/protection/options.h"
#include "engine/protection/segment_chains.h"

namespace ccdt {

/// Splits every missing grazeable segment until each is a chain of Delaunay edges (paper, section 2), so that the
/// constrained Delaunay tetrahedralization exists (Shewchuk 2002).
///
/// `midpoint` bisects. `shell` splits at the foot of the vertex that encroaches most, so that one split is enough for
/// one vertex; but if that vertex is on a segment that meets this one, at the same distance from where they meet: the
/// pieces of all segments there end on common spheres, and cannot split each other for ever (Ruppert 1995; Si and
/// Gaertner 2005). Split points are dyadic fractions of the segment, j / 2^20, and lie on it exactly.
///
/// \param must_be_chain  by segment: shall it become a chain of Delaunay edges?
/// \param delaunay  the tetrahedralization of the vertices of `plc`; gains the Steiner vertices, whose ids follow the
///                  existing ones
/// \param chains    kept up to date; on entry the state of an earlier call, or the bare segments (`bare_chains`)
/// \return          the number of Steiner vertices added
/// \throw LimitError  a segment would need a split finer than 2^-20 of it; carries the place
std::uint64_t protect_edges(const Plc& plc, const std::vector<bool>& must_be_chain, Protection strategy,
                            Delaunay& delaunay, SegmentChains& chains, const Progress& progress = {});

/// The segments before any split.
SegmentChains bare_chains(const Plc& plc);

/// How many vertices were put on segments at each level, from level 1; for `midpoint` that is the depth of the
/// bisection.
std::vector<std::uint64_t> count_splits_by_level(const SegmentChains& chains);

/// Which segments need protection: the grazeable ones.
std::vector<bool> grazeable_segments(const Plc& plc);

/// Inserts interior points, in the order of a Hilbert curve, each unless it would knock a protected edge out of the
/// tetrahedralization: then the point is dropped, rather than the edge split for its sake.
///
/// \param must_be_chain  by segment: are its pieces Delaunay edges that must stay?
/// \return how many points were inserted; their ids follow the existing ones
std::uint64_t insert_interior(std::span<const Point3> points, const std::vector<bool>& must_be_chain,
                              const SegmentChains& chains, Delaunay& delaunay, const Progress& progress = {});

/// The same with the same result, but all vertices are tetrahedralized anew by `wrap_delaunay`. Only if edges are
/// missing then, the points to drop are found by insertion.
std::uint64_t wrap_interior(std::span<const Point3> points, const std::vector<bool>& must_be_chain,
                            const SegmentChains& chains, double grid_scale, Delaunay& delaunay,
                            const Progress& progress = {});

}  // namespace ccdt
