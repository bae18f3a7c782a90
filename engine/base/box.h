#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/base/point.h"

namespace ccdt {

/// The segment from a point to that point plus a vector.
struct LineSegment {
  Point3 from, along;
};

/// The points not farther from a center than a radius.
struct Ball {
  Point3 center;
  double radius;
};

/// An axis-parallel box with its boundary.
struct Box {
  Point3 low, high;

  Point3 center() const { return 0.5 * (low + high); }
  // It is unpredictable which of the six comparisons fails, so all are made without branches.
  bool meets(const Box& o) const {
    return (int{low.x <= o.high.x} & int{o.low.x <= high.x} & int{low.y <= o.high.y} & int{o.low.y <= high.y} &
            int{low.z <= o.high.z} & int{o.low.z <= high.z}) != 0;
  }
  /// Up to rounding.
  bool meets(const Ball& ball) const {
    const Point3 nearest = componentwise_max(low, componentwise_min(high, ball.center));
    return squared_length(nearest - ball.center) <= ball.radius * ball.radius;
  }
  // Narrows the segment to the part between each two parallel planes of the box. Up to rounding.
  bool meets(const LineSegment& s) const {
    double from = 0, to = 1;
    const auto clip = [&](double least, double most, double start, double along) {
      if (along == 0) {
        if (start < least || start > most) to = -1;
        return;
      }
      const double a = (least - start) / along, b = (most - start) / along;
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    };
    clip(low.x, high.x, s.from.x, s.along.x);
    clip(low.y, high.y, s.from.y, s.along.y);
    clip(low.z, high.z, s.from.z, s.along.z);
    return from <= to;
  }
};

/// The empty box: the hull of it and another box is the other box.
inline constexpr Box empty_box = {{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};

inline bool is_empty(const Box& box) {
  return box.low.x > box.high.x;
}

inline Box hull(const Box& a, const Box& b) {
  return {componentwise_min(a.low, b.low), componentwise_max(a.high, b.high)};
}

inline Box box_of(const Point3& p) {
  return {p, p};
}

/// \return  `empty_box` if there are no points
inline Box bounding_box(std::span<const Point3> points) {
  Box box = empty_box;
  for (const Point3& p : points) box = hull(box, box_of(p));
  return box;
}

/// The largest extent of the points along an axis; 0 if there are none.
inline double largest_extent(std::span<const Point3> points) {
  const Box box = bounding_box(points);
  return points.empty() ? 0 : std::max({box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z});
}

/// The largest magnitude of a coordinate; 0 if there are no points.
inline double largest_coordinate(std::span<const Point3> points) {
  double largest = 0;
  for (const Point3& p : points) largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  return largest;
}

inline Box intersection(const Box& a, const Box& b) {
  return {componentwise_max(a.low, b.low), componentwise_min(a.high, b.high)};
}

/// The box with a margin added on all sides.
inline Box expanded(const Box& box, double margin) {
  const Point3 m{margin, margin, margin};
  return {box.low - m, box.high + m};
}

inline bool strictly_contains(const Box& box, const Point3& p) {
  return p.x > box.low.x && p.x < box.high.x && p.y > box.low.y && p.y < box.high.y && p.z > box.low.z &&
         p.z < box.high.z;
}

inline bool contains(const Box& outer, const Box& inner) {
  return inner.low.x >= outer.low.x && inner.high.x <= outer.high.x && inner.low.y >= outer.low.y &&
         inner.high.y <= outer.high.y && inner.low.z >= outer.low.z && inner.high.z <= outer.high.z;
}

inline double squared_distance(const Box& a, const Box& b) {
  const auto gap = [](double a_low, double a_high, double b_low, double b_high) {
    return std::max(std::max(a_low - b_high, b_low - a_high), 0.0);
  };
  return squared_length({gap(a.low.x, a.high.x, b.low.x, b.high.x), gap(a.low.y, a.high.y, b.low.y, b.high.y),
                         gap(a.low.z, a.high.z, b.low.z, b.high.z)});
}

inline double squared_distance(const Box& box, const Point3& p) {
  return squared_distance(box, box_of(p));
}

/// The squared distance to the point of the box that is farthest from p.
inline double squared_farthest_distance(const Box& box, const Point3& p) {
  return squared_length(componentwise_max(p - box.low, box.high - p));
}

}  // namespace ccdt
