#pragma once

#include <vector>

#include "engine/base/point.h"
#include "engine/base/progress.h"
#include "engine/lattice/domain_surface.h"
#include "engine/lattice/options.h"

namespace ccdt::lattice {

/// Places interior points in a crystal lattice on an octree (paper, section 3). All points are integers in grid units,
/// pairwise different, strictly inside the domain, outside the smallest sphere through any surface triangle and any
/// subsegment, and at least about half an edge length away from all triangles, subsegments and vertices (the two
/// distances are options). In Morton order of the octree; the same for any order of the triangles.
///
/// With a grading, the target edge length at x is the least of `edge_length` (if any) and, over the surface, of
/// (mean edge length there + grading * distance). Leaves halve from level to level, so the lattice has it within a
/// factor of sqrt(2), and within 0.4 per cent where it is `edge_length` or, if that is 0, the mean edge length of the
/// surface. Without a grading all leaves are of that one size. For the constants of the lattices see octree.h.
///
/// With a background its sizes take the place of the surface's edge lengths. If it has tetrahedra, the target is linear
/// in each, and outside that of the nearest vertex; the grading plays no part. If it has vertices alone, the target is
/// the least over these of (size + grading * distance). Either way `edge_length`, if given, is an upper bound.
///
/// \param surface     in grid units; its subsegments protect the segments, also those that no triangle has
/// \throw LimitError  more points than vertex ids
std::vector<Point3> place_lattice_points(const DomainSurface& surface, const LatticeOptions& options,
                                         const Progress& progress = {});

}  // namespace ccdt::lattice
