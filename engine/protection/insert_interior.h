#pragma once

#include <cstdint>
#include <span>

#include "engine/base/point.h"
#include "engine/base/progress.h"
#include "engine/delaunay/delaunay.h"
#include "engine/protection/segment_chains.h"

namespace ccdt {

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
