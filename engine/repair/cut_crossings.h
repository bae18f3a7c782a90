#pragma once

#include <cstddef>

#include "engine/base/progress.h"
#include "engine/plc/build_plc.h"

namespace ccdt::repair {

/// What was done where triangles crossed or covered each other.
struct CutCounts {
  std::size_t pairs = 0;   ///< of triangles that shared more than corners and edges at first
  std::size_t rounds = 0;  ///< of cuts and welds; one if nothing almost touches
  std::size_t left = 0;    ///< pairs that still meet: all or none
};

struct CutOptions {
  double tolerance = 0;  ///< in grid units: things this close should touch; a few times the spacing is always close
                         ///< enough, because of rounding
  double spacing = DyadicGrid::quantum;  ///< vertices are rounded to multiples of it: a power of two times the quantum
  bool weld_everywhere = false;          ///< also where nothing crosses
};

/// Cuts triangles along their intersections, so that they meet only in common vertices and edges. Triangles that become
/// equal are merged: the first one stays. Triangles without area are dropped.
///
/// The points where triangles meet are found exactly and rounded to multiples of the spacing. Equal points are one
/// vertex, in all triangles that have it, so the surface stays closed where it was. What rounding makes cross is cut in
/// another round. Where all ends of a cut are rounded to corners, these are joined.
///
/// Facets that should touch, such as those of two rotated solids, one on top of the other, touch only up to the
/// rounding of their vertices. So where triangles cross, whatever is within the tolerance is welded before it is cut.
/// This merges vertices and renumbers them. Welds bend what is near them, which can cross again without end; then
/// everything is cut again without welds. If that does not end either, the soup stays as it is.
///
/// With the quantum as spacing, a soup without crossings, vertices on triangles, equal triangles and triangles without
/// area stays as it is. Segments
/// that are edges are divided with them; other segments may still cross triangles.
CutCounts cut_crossings(plc::UncheckedPlc& soup, const CutOptions& options = {}, const Progress& progress = {});

}  // namespace ccdt::repair
