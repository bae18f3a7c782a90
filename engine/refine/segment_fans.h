#pragma once

#include <vector>

#include "engine/base/point.h"

namespace ccdt::refine {

/// A segment as its common end with others sees it.
struct Spoke {
  Point3 along;     ///< from the common end to the other one
  double step = 0;  ///< the distance between the places for vertices
  bool grazeable = false;
};

/// Finds the fans of the segments at a vertex: those that are joined by angles below 30 degrees. A vertex on a segment
/// of a fan encroaches on all others, so the closest two decide for the whole fan.
///
/// A step over the squared sine of an angle is the distance from the vertex at which two segments are so far apart that
/// places on both fit each other. At a distance r they are r sin apart, and vertices there fit if their distances
/// differ by at most a multiple of (r sin)^2 / r. The larger step of the two counts, and only grazeable segments are
/// split because of each other; other pairs count as one step.
///
/// The directions are sorted into a tree of boxes, where whole boxes are joined or left out. So the time is nearly
/// linear.
///
/// \return  for each segment the largest such distance within its fan; 0: it is alone; infinite: two seem to coincide
std::vector<double> find_fan_distances(const std::vector<Spoke>& spokes);

}  // namespace ccdt::refine
