#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/base/point.h"
#include "engine/geometry/box_tree.h"

namespace ccdt::locate {

/// A vertex in a locator: a copy, so that nearby vertices are near each other in memory.
struct LocatedVertex {
  Point3 point;
  std::uint32_t rank, id;
};

/// The search region for the apex of a face: the points above the plane of the face that are in a ball, which shrinks
/// with every better vertex. In floating point: slightly too large, never too small.
class Cap {
 public:
  /// Everything above the triangle abc.
  Cap(const Point3& a, const Point3& b, const Point3& c) : foot_(a) {
    const Point3 u = b - a, v = c - a;
    normal_ = cross(u, v);
    // The rounding error of a point's height, times the length of the normal: 16 * 2^-53 * |u| |v| times its distance,
    // which is below 2^53 grid units, rounded up.
    slack_ = 32 * std::sqrt(squared_length(u) * squared_length(v));
  }

  void shrink_to(const Point3& center, double radius) {
    center_ = center;
    radius_ = radius;
    squared_radius_ = radius * radius;
  }

  const Point3& center() const { return center_; }
  double radius() const { return radius_; }

  bool may_hold(const Point3& p) const {
    return dot(normal_, p - foot_) >= -slack_ && squared_length(p - center_) <= squared_radius_;
  }

  /// Is the box certainly outside?
  bool misses(const Box& box) const {
    const Point3 top{(normal_.x > 0 ? box.high.x : box.low.x) - foot_.x,
                     (normal_.y > 0 ? box.high.y : box.low.y) - foot_.y,
                     (normal_.z > 0 ? box.high.z : box.low.z) - foot_.z};
    return dot(normal_, top) < -slack_ || squared_distance(box, center_) > squared_radius_;
  }

 private:
  Point3 foot_, normal_;
  double slack_;
  Point3 center_;
  double radius_ = std::numeric_limits<double>::infinity(), squared_radius_ = radius_;
};

}  // namespace ccdt::locate
