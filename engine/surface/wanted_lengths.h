#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/point.h"
#include "engine/geometry/box_tree.h"
#include "engine/surface/feature_curves.h"

namespace ccdt::surface {

/// The growth of the wanted edge length per unit of distance from a place where shorter edges are wanted.
inline constexpr double length_growth = 0.3;

/// The largest distance between the middle of an edge and the original surface or feature, as a fraction of its length:
/// a circle keeps at least eighteen edges.
inline constexpr double most_deviation = 0.044;

/// The same for the edges that improve bad triangles: a circle keeps fifteen edges.
inline constexpr double most_deviation_of_improved = 0.055;

/// The wanted edge length at each place: that of the options, except in some balls, where it is less. Around these it
/// grows gently.
class EdgeLengths {
 public:
  struct Ball {
    Point3 center;
    double radius, wanted;
  };

  explicit EdgeLengths(double usual) : usual_(usual) {}

  double usual() const { return usual_; }
  double at(const Point3& p) const;

  void limit(const std::vector<Ball>& balls);

 private:
  double usual_;
  std::vector<Ball> balls_;
  BoxTree reaches_;  // of the balls that need less than the usual length
};

/// The longest edges that feature curves allow: short curves between corners stay single edges, and a bent curve needs
/// edges that stay near it (`most_deviation`).
class CurveLengths {
 public:
  /// \param usual  the edge length wanted where the curve does not need less
  CurveLengths(const FeatureCurves& features, double usual);

  double at(std::uint32_t curve, double arc) const;

 private:
  const FeatureCurves& features_;
  std::vector<std::vector<double>> lengths_;  // by curve, at each of its points
};

}  // namespace ccdt::surface
