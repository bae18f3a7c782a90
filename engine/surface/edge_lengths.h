#pragma once

#include <algorithm>
#include <vector>

#include "engine/surface/vector_math.h"

namespace ccdt {

/// The edge length that is wanted at each place: the one of the options but for some balls, where it is less; around
/// them it grows gently.
class EdgeLengths {
 public:
  explicit EdgeLengths(double usual) : usual_(usual) {}

  double at(const Point3& p) const {
    double wanted = usual_;
    for (const Ball& ball : balls_)
      wanted = std::min(wanted, ball.wanted + growth * std::max(0.0, length(p - ball.center) - ball.radius));
    return wanted;
  }

  void limit(const Point3& center, double radius, double wanted) { balls_.push_back({center, radius, wanted}); }

 private:
  static constexpr double growth = 0.3;  // of the length per length

  struct Ball {
    Point3 center;
    double radius, wanted;
  };
  double usual_;
  std::vector<Ball> balls_;
};

}  // namespace ccdt
