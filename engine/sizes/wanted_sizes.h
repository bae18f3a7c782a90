#pragma once

#include <vector>

#include "engine/geometry/grid.h"
#include "engine/sizes/background_sizes.h"
#include "engine/sizes/size_field.h"

namespace ccdt::sizes {

/// What a user wants besides one edge length, in grid units.
struct WantedSizes {
  std::vector<SizedPlace> places;
  BackgroundSizes background;

  bool empty() const { return places.empty() && background.empty(); }
};

inline BackgroundSizes in_grid_units(BackgroundSizes background, const DyadicGrid& grid) {
  for (Point3& p : background.vertices) p = (1 / grid.unit) * (p - grid.origin);
  for (double& size : background.sizes) size /= grid.unit;
  return background;
}

}  // namespace ccdt::sizes
