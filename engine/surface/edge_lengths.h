#pragma once

#include <algorithm>
#include <vector>

#include "engine/surface/vector_math.h"

namespace ccdt {

/// How much longer edges may be wanted, per length of the way from a place where shorter ones are wanted.
inline constexpr double length_growth = 0.3;

/// The edge length that is wanted at each place: the one of the options but for some balls, where it is less; around
/// them it grows gently.
class EdgeLengths {
 public:
  explicit EdgeLengths(double usual) : usual_(usual) {}

  double at(const Point3& p) const {
    double wanted = usual_;
    for (const Ball& ball : balls_)
      wanted = std::min(wanted, ball.wanted + length_growth * std::max(0.0, length(p - ball.center) - ball.radius));
    return wanted;
  }

  void limit(const Point3& center, double radius, double wanted) { balls_.push_back({center, radius, wanted}); }

 private:
  struct Ball {
    Point3 center;
    double radius, wanted;
  };
  double usual_;
  std::vector<Ball> balls_;
};

}  // namespace ccdt
