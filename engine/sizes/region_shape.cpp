#include "engine/sizes/region_shape.h"

#include <cmath>
#include <cstdint>

#include "engine/geometry/closest_point.h"
#include "engine/geometry/ray.h"

namespace ccdt::sizes {

RegionShape::RegionShape(const plc::Plc& plc, RegionId region) {
  for (const plc::Facet& facet : plc.facets) {
    if (facet.above != region && facet.below != region) continue;
    for (const auto& [a, b, c] : plc.triangles_of(facet))
      borders_.push_back(
          {{plc.vertices[a], plc.vertices[b], plc.vertices[c]}, facet.above == region, facet.below == region});
  }
  tree_ = BoxTree(borders_, [](const Border& border) { return bounding_box(border.corners); });
  for (const Border& border : borders_) bounds_ = hull(bounds_, bounding_box(border.corners));
}

Filling RegionShape::filling_of(const Box& cube) const {
  const double reach = 0.25 * squared_length(cube.high - cube.low);  // of the cube, squared
  const bool has_border = tree_.any_below(
      HUGE_VAL, [&](const Box& box, double) { return box.meets(cube) ? 0 : HUGE_VAL; },
      [&](const BoxTree::Item& item) {
        return squared_distance(borders_[item.number].corners, cube.center()) <= reach;
      });
  if (has_border) return Filling::part;
  return contains(cube.center()) ? Filling::all : Filling::none;
}

/// Looks at the nearest triangle. The side of the first one on the way to it tells.
bool RegionShape::contains(const Point3& p) const {
  if (borders_.empty()) return false;
  double nearest = HUGE_VAL;
  std::uint32_t first = 0;
  tree_.any_below(
      nearest, [&](const Box& box, double) { return squared_distance(box, p); },
      [&](const BoxTree::Item& item) {
        if (const double found = squared_distance(borders_[item.number].corners, p); found < nearest)
          nearest = found, first = item.number;
        return false;
      });
  const auto& [a, b, c] = borders_[first].corners;
  const LineSegment way{p, (1.0 / 3) * (a + b + c) - p};
  double least = 1;
  tree_.for_each_meeting(way, [&](std::uint32_t number) {
    if (const double where = crossing_of(way, borders_[number].corners); where < least) least = where, first = number;
  });
  const Border& border = borders_[first];
  return dot(area_vector(border.corners), way.along) < 0 ? border.is_above : border.is_below;
}

}  // namespace ccdt::sizes
