#pragma once

#include <vector>

#include "engine/base/point.h"
#include "engine/base/progress.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"
#include "engine/sizes/wanted_sizes.h"

namespace ccdt::refine {

struct RefineOptions {
  double edge_length = 0;          ///< longest wanted edges, in grid units; must be positive
  double grading = 0.5;            ///< growth of the edge length per unit of distance from places where it is short
  double most_tetrahedra = 2e6;    ///< about how many tetrahedra thin places may cause
  sizes::WantedSizes wanted = {};  ///< where edges should be shorter
};

/// A PLC with more vertices and the same geometry.
struct RefinedPlc {
  plc::Plc plc;                      ///< the vertices that were added inside facets follow those of the input
  protection::SegmentChains chains;  ///< the vertices that were added inside segments
  std::vector<Point3> on_segments;   ///< these, in the order of their ids, which follow those of `plc`
};

/// Adds vertices to facets and segments, so that their triangles are well shaped and have edges of the wanted length,
/// or shorter ones at thin places (`sizes::find_thin_places`). Segments are divided first. Then each facet is refined
/// at circumcenters of its worst triangles (Chew 1993, Ruppert 1995, Shewchuk 2002).
///
/// A vertex inside a segment is at a dyadic fraction of it. One inside a facet is a corner of the facet plus integer
/// multiples of two steps in its plane (`plc::PlaneSteps`). So all are exactly in place. In a nearly flat facet, a
/// vertex is exactly in the plane of one of its triangles.
///
/// It terminates at all angles: no edge shorter than the length wanted there is halved, and no vertex is placed nearer
/// to another one than a fraction of that length.
RefinedPlc refine_plc(const plc::Plc& plc, const RefineOptions& options, const Progress& progress = {});

}  // namespace ccdt::refine
