#pragma once

#include <array>
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

  /// The point at an arc length; exactly on the chain where the chain is parallel to an axis.
  Point3 at(double arc_length) const;

  /// The arc length of the bend nearest to a given arc length, if one is within reach; otherwise the given one. A chain
  /// with vertices at its bends does not shrink.
  double at_bend(double arc_length, double reach) const;

  /// The largest distance of the chain, between two arc lengths, from the straight line through its points there.
  double deviation(double from, double to) const;
};

/// The curve that a feature edge is on, and where on the curve it is.
struct CurvePiece {
  std::uint32_t curve;
  std::array<double, 2> arc;  ///< at the ends of the feature, in its order
};

struct FeatureCurves {
  std::vector<FeatureCurve> curves;
  std::vector<CurvePiece> piece_of;  ///< of each feature
  std::vector<char> is_corner;       ///< of each point: it must stay where it is
};

/// Chains the features. A point is a corner if one feature or more than two end there, if its two features turn by more
/// than the sharp angle or are of different kinds, if one of its wedges does not reach from feature to feature, or if
/// the input lists it alone. A loop without a corner gets one.
FeatureCurves chain_features(const OriginalSurface& surface, double sharp_angle);

}  // namespace ccdt::surface
