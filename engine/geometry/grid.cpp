#include "engine/geometry/grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/box.h"

namespace ccdt {

double round_to_unit(double grid) {
  return std::nearbyint(grid);
}

Point3 DyadicGrid::snap(const Point3& world) const {
  const double q = unit * quantum;
  const auto snap_one = [&](double x, double o) { return std::nearbyint((x - o) / q) * quantum; };
  return {snap_one(world.x, origin.x), snap_one(world.y, origin.y), snap_one(world.z, origin.z)};
}

Point3 DyadicGrid::to_world(const Point3& grid) const {
  return {origin.x + grid.x * unit, origin.y + grid.y * unit, origin.z + grid.z * unit};
}

DyadicGrid make_grid(std::span<const Point3> world) {
  const auto [low, high] = bounding_box(world);
  // Halves before subtracting, since the extent of finite coordinates may overflow.
  const double half =
      world.empty() ? 0 : std::max({high.x / 2 - low.x / 2, high.y / 2 - low.y / 2, high.z / 2 - low.z / 2});
  int exponent = 0;
  if (half > 0) {
    const double mantissa = std::frexp(half, &exponent);  // half = mantissa * 2^exponent, mantissa in [0.5, 1)
    exponent += mantissa == 0.5 ? 0 : 1;                  // 2^exponent is the smallest power not below the extent
  } else if (!world.empty()) {
    // One point, which may be so far away that it is not a number of quanta of the usual size.
    std::frexp(std::max({std::fabs(low.x), std::fabs(low.y), std::fabs(low.z)}), &exponent);
    exponent = std::max(exponent - std::numeric_limits<double>::digits, 0);
  }
  // Below this, the quantum would be zero; such an input is effectively a point.
  exponent = std::max(exponent, std::numeric_limits<double>::min_exponent + 64);
  DyadicGrid grid;
  grid.unit = std::ldexp(1.0, exponent - 52);
  if (!world.empty()) {
    const double q = grid.unit * DyadicGrid::quantum;
    const auto center = [&](double l, double h) { return std::nearbyint((l / 2 + h / 2) / q) * q; };
    grid.origin = {center(low.x, high.x), center(low.y, high.y), center(low.z, high.z)};
  }
  return grid;
}

}  // namespace ccdt
