#pragma once

#include <vector>

#include "engine/base/point.h"
#include "engine/base/progress.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::refine {

struct RefineOptions {
  double edge_length = 0;        ///< longest wanted edges, in grid units; must be positive
  double grading = 0.5;          ///< growth of the edge length per unit of distance from places where it is short
  double most_tetrahedra = 2e6;  ///< from thin places, approximately; the thinnest then count as thicker
  /// Places where a shorter edge length is wanted count as thicker; in grid units. 0: the limit of tetrahedra decides.
  double least_size = 0;
};

/// A PLC with more vertices and the same geometry.
struct RefinedPlc {
  plc::Plc plc;                      ///< the vertices that were added inside facets follow those of the input
  protection::SegmentChains chains;  ///< the vertices that were added inside segments
  std::vector<Point3> on_segments;   ///< these, in the order of their ids, which follow those of `plc`
  double least_size = 0;             ///< the `least_size` that was used
};

/// Gives facets and segments the vertices with which their triangles are well shaped and have edges of a wanted length
/// (`SurfaceSizes`): segments are divided first, then each facet is refined by circumcenters of its worst triangles
/// (Chew 1993, Ruppert 1995, Shewchuk 2002).
///
/// A vertex inside a segment is a dyadic fraction of it, and one inside a facet a corner of it plus integer multiples
/// of two steps in its plane (`plc::PlaneSteps`), so all are exactly in place. In a facet that is flat only within the
/// tolerance, they are exactly in one of its triangles' planes.
///
/// It terminates at all angles: no edge shorter than the length wanted there is halved, and no vertex is placed nearer
/// to another one than a fraction of that length.
RefinedPlc refine_plc(const plc::Plc& plc, const RefineOptions& options, const Progress& progress = {});

}  // namespace ccdt::refine
