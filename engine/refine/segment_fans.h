#pragma once

#include <vector>

#include "engine/base/point.h"

namespace ccdt::refine {

/// A segment as seen from its common end with others.
struct Spoke {
  Point3 along;     ///< from the common end to the other one
  double step = 0;  ///< the distance between possible vertices
  bool grazeable = false;
};

/// Finds the fans of the segments at a vertex. A fan's segments are joined by angles below 30 degrees. A vertex on a
/// segment of a fan encroaches on all others, so the closest two decide for the whole fan.
///
/// At a distance r from the vertex, two segments are r sin apart, and vertices there fit each other if their distances
/// differ by at most a multiple of (r sin)^2 / r. So they can fit from a distance of a step over the squared sine on.
/// The larger step of the two counts. Only grazeable segments are split because of each other; other pairs count as one
/// step.
///
/// The directions are sorted into a tree of boxes, and whole boxes are joined or left out. So the time is nearly
/// linear.
///
/// \return  for each segment the largest such distance within its fan; 0: it is alone; infinite: two seem to coincide
std::vector<double> find_fan_distances(const std::vector<Spoke>& spokes);

}  // namespace ccdt::refine
