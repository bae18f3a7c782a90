#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/progress.h"
#include "engine/lattice/octree.h"

namespace ccdt::lattice {

/// Interior points, and their places in the lattices of an octree.
struct LatticePoints {
  std::vector<Point3> points;              ///< in grid units
  std::vector<std::uint8_t> levels;        ///< of each point: the level of the leaf that holds it
  std::vector<std::uint8_t> later_rounds;  ///< of each point: how many rounds of insertion follow its own
  Lattice kind = Lattice::none;
  Point3 origin;       ///< of the octree; a point is this plus whole octree units
  double unit = 1;     ///< one octree unit in grid units
  unsigned depth = 0;  ///< the sides of the leaves of a level are 2^(depth - level + 1) octree units
  /// The share of the inner leaves that have only inner leaves of their own level around them. Estimated from a sample.
  double share_in_one_level = 0;
};

/// Places interior points in a crystal lattice on an octree (paper, section 3). All points are distinct integers in
/// grid units, strictly inside the domain, outside the smallest sphere through any surface triangle and any subsegment,
/// and at least about half an edge length away from all triangles, subsegments and vertices (the two distances are
/// options). In Morton order of the octree; the same for any order of the triangles.
///
/// With a grading, the target edge length at x is the least of `edge_length` (if any) and, over the surface, (mean edge
/// length there + grading * distance). Leaves halve from level to level, so the lattice matches the target within a
/// factor of sqrt(2), and within 0.4 percent where it is `edge_length` or, if that is 0, the mean edge length of the
/// surface. Without a grading, all leaves have that size. For the constants of the lattices see octree.h.
///
/// With a background, its sizes replace the edge lengths of the surface. If it has tetrahedra, the target is linear in
/// each, and outside of them it is that of the nearest vertex; the grading plays no part. If it has only vertices, the
/// target is the least over these of (size + grading * distance). Either way `edge_length`, if given, is an upper
/// bound.
///
/// \param any_order   the surface in grid units, its triangles in any order; its subsegments include those of segments
///                    that no triangle has
/// \throw LimitError  more points than vertex ids
LatticePoints place_lattice_points(const DomainSurface& any_order, const LatticeOptions& options,
                                   const Progress& progress = {});

/// Checks the number of points before memory is allocated. They are nowhere coarser than the largest target.
///
/// \throw LimitError  more points than vertex ids
void check_number_of_points(const DomainSurface& surface, const TargetSizes& size);

/// Leaves out all points but these.
///
/// \param those  indices, in increasing order
void keep_only(std::span<const std::uint32_t> those, LatticePoints& points);

}  // namespace ccdt::lattice
