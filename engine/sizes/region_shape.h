#pragma once

#include <vector>

#include "engine/geometry/box_tree.h"
#include "engine/plc/plc.h"
#include "engine/sizes/cover.h"
#include "engine/sizes/triangle.h"

namespace ccdt::sizes {

/// The space of a region, in grid units. In floating point: good enough for sizes.
class RegionShape {
 public:
  RegionShape(const plc::Plc& plc, RegionId region);

  Filling filling_of(const Box& cube) const;
  /// Encloses the region; empty if no facet bounds it.
  const Box& bounds() const { return bounds_; }

 private:
  /// A triangle of a facet that bounds the region.
  struct Border {
    Triangle corners;
    bool is_above, is_below;  ///< where is the region?
  };

  bool contains(const Point3& p) const;

  std::vector<Border> borders_;
  BoxTree tree_;
  Box bounds_ = empty_box;
};

}  // namespace ccdt::sizes
