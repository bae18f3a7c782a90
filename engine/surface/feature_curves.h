#pragma once

#include <cstdint>
#include <vector>

#include "engine/surface/original_surface.h"

namespace ccdt::surface {

/// A chain of features from corner to corner, and the arc length of each of its points.
struct FeatureCurve {
  std::vector<Point3> points;
  std::vector<double> arc;  ///< length of the chain up to each point
  bool is_segment = false;
  int marker = 0;

  /// The point at an arc length, exactly on the chain where that is parallel to an axis.
  Point3 at(double arc_length) const;

  /// The arc length of the bend of the chain that is nearest to another arc length, if it is within reach; else that
  /// one itself. A chain that runs through its bends does not shrink.
  double at_bend(double arc_length, double reach) const;

  /// The largest distance of the chain between two arc lengths from the straight line between these.
  double deviation(double from, double to) const;
};

/// The curve of a feature edge, and its place on it.
struct CurvePiece {
  std::uint32_t curve;
  std::array<double, 2> arc;  ///< at the ends of the feature, in its order
};

struct FeatureCurves {
  std::vector<FeatureCurve> curves;
  std::vector<CurvePiece> piece_of;  ///< of each feature
  std::vector<char> is_corner;       ///< of each point: it must stay where it is
};

/// Chains the features. A point is a corner if not exactly two features end at it, if they turn by more than the sharp
/// angle or are of different kinds, if it belongs to more than the two features bound, or if the input lists it alone.
/// A loop without a corner gets one.
FeatureCurves chain_features(const OriginalSurface& surface, double sharp_angle);

}  // namespace ccdt::surface
