#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/point.h"
#include "engine/base/progress.h"
#include "engine/lattice/options.h"

namespace ccdt {

/// A triangle of a facet, counterclockwise seen from above, and what is on its two sides.
struct SurfaceTriangle {
  std::array<VertexId, 3> vertices;
  bool inside_above = false, inside_below = false;  ///< does the domain lie there?
};

/// Places interior points in a crystal lattice on an octree (paper, section 3). All points are integers in grid units,
/// pairwise different, strictly inside the domain, outside the smallest sphere through any surface triangle and any
/// subsegment, and at least about half an edge length away from all triangles, subsegments and vertices (the two
/// distances are options). In Morton order of the octree; the same for any order of the triangles.
///
/// With a grading, the target edge length at x is the least of `edge_length` (if any) and, over the surface, of
/// (mean edge length there + grading * distance). Leaves halve from level to level, so the lattice has it within a
/// factor of sqrt(2), and within 0.4 per cent where it is `edge_length` or, if that is 0, the mean edge length of the
/// surface. Without a grading all leaves are of that one size. For the constants of the lattices see cell_size.h.
///
/// With a background its sizes take the place of the surface's edge lengths. If it has tetrahedra, the target is linear
/// in each, and outside that of the nearest vertex; the grading plays no part. If it has vertices alone, the target is
/// the least over these of (size + grading * distance). Either way `edge_length`, if given, is an upper bound.
///
/// \param vertices     grid units
/// \param subsegments  edges that protect the segments, also those that no triangle has
/// \throw LimitError   more points than vertex ids
std::vector<Point3> place_lattice_points(std::span<const Point3> vertices, std::span<const SurfaceTriangle> triangles,
                                         std::span<const std::array<VertexId, 2>> subsegments,
                                         const LatticeOptions& options, const Progress& progress = {});

}  // namespace ccdt
