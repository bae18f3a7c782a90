#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/base/progress.h"
#include "engine/delaunay/delaunay.h"
#include "engine/lattice/place_lattice_points.h"
#include "engine/plc/plc.h"
#include "engine/protection/options.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::protection {

/// A Delaunay tetrahedralization and the segments, those that need protection as chains of its edges.
struct ProtectedDelaunay {
  delaunay::Delaunay delaunay;
  SegmentChains chains;
  std::vector<bool> must_be_chain;  ///< by segment: must its pieces be Delaunay edges?
};

/// The state before protection, in which the grazeable segments must still become chains of Delaunay edges.
///
/// \param delaunay  of the vertices of `plc` and of those inside the chains
/// \param chains    vertices that the segments have already, the first ones after those of `plc`; empty: none
ProtectedDelaunay unprotected(const plc::Plc& plc, delaunay::Delaunay delaunay, SegmentChains chains = {});

/// Splits every missing grazeable segment until each is a chain of Delaunay edges (paper, section 2), so that the
/// constrained Delaunay tetrahedralization exists (Shewchuk 2002).
///
/// `midpoint` bisects. `shell` splits at the foot of the vertex that encroaches most, so that one split is enough for
/// one vertex; but if that vertex is on a segment that meets this one, at the same distance from where they meet: the
/// pieces of all segments there end on common spheres, and cannot split each other forever (Ruppert 1995; Si and
/// Gaertner 2005). Pieces of segments that have been split often are not split near to their ends. Split points are
/// dyadic fractions of the segment, j / 2^20, and lie on it exactly.
///
/// \param start     `unprotected`, or the state of an earlier call, with more vertices
/// \return          the same with the Steiner vertices, whose ids follow the existing ones
/// \throw LimitError  a segment would need a split finer than 2^-20 of it; carries the place
ProtectedDelaunay protect_edges(const plc::Plc& plc, ProtectedDelaunay start, Protection strategy,
                                const Progress& progress = {});

/// How many vertices were put on segments at each level, from level 1; for `midpoint` that is the depth of the
/// bisection.
std::vector<std::uint64_t> count_splits_by_level(const SegmentChains& chains);

/// Inserts interior points along a Hilbert curve, except those that would destroy a protected edge: such a point is
/// dropped rather than the edge split.
///
/// \return  the tetrahedralization with the points, whose ids follow the existing ones
delaunay::Delaunay insert_interior(std::span<const Point3> points, ProtectedDelaunay start,
                                   const Progress& progress = {});

/// A Delaunay tetrahedralization that has cells of lattice cores.
struct CoreDelaunay {
  delaunay::Delaunay delaunay;
  std::size_t core_cells = 0;  ///< how many
};

/// The same with the same result, but the cells deep within a lattice are written down, and only the other points are
/// inserted (cores/lattice_core.h).
CoreDelaunay core_interior(const lattice::LatticePoints& lattice, ProtectedDelaunay start,
                           const Progress& progress = {});

/// The same with the same result, but all vertices are tetrahedralized anew by `wrap_delaunay`. Only if edges are
/// missing then, the points to drop are found by insertion.
///
/// \param grid_scale  of `wrap_delaunay`
delaunay::Delaunay wrap_interior(std::span<const Point3> points, ProtectedDelaunay start, double grid_scale,
                                 const Progress& progress = {});

}  // namespace ccdt::protection
