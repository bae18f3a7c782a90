#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/numbers/point.h"

namespace ccdt {

/// An axis-parallel box with its border.
struct Box {
  Point3 low, high;

  Point3 centre() const { return 0.5 * (low + high); }
};

inline Box bounding_box(std::span<const Point3> points) {
  Box box{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
  for (const Point3& p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

inline Box intersection(const Box& a, const Box& b) {
  return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)},
          {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)}};
}

inline bool strictly_contains(const Box& box, const Point3& p) {
  return p.x > box.low.x && p.x < box.high.x && p.y > box.low.y && p.y < box.high.y && p.z > box.low.z &&
         p.z < box.high.z;
}

inline bool contains(const Box& outer, const Box& inner) {
  return inner.low.x >= outer.low.x && inner.high.x <= outer.high.x && inner.low.y >= outer.low.y &&
         inner.high.y <= outer.high.y && inner.low.z >= outer.low.z && inner.high.z <= outer.high.z;
}

inline bool overlap(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

inline double squared_distance(const Box& a, const Box& b) {
  return squared_length({std::max({a.low.x - b.high.x, b.low.x - a.high.x, 0.0}),
                         std::max({a.low.y - b.high.y, b.low.y - a.high.y, 0.0}),
                         std::max({a.low.z - b.high.z, b.low.z - a.high.z, 0.0})});
}

inline double squared_distance(const Box& box, const Point3& p) {
  return squared_distance(box, Box{p, p});
}

/// To the point of the box that is farthest from p.
inline double squared_farthest_distance(const Box& box, const Point3& p) {
  return squared_length({std::max(p.x - box.low.x, box.high.x - p.x), std::max(p.y - box.low.y, box.high.y - p.y),
                         std::max(p.z - box.low.z, box.high.z - p.z)});
}

}  // namespace ccdt
