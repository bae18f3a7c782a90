#include "engine/base/uniform_grid.h"

namespace ccdt {

UniformGrid make_uniform_grid(const Box& box, std::size_t items, double scale) {
  const Point3 extent = box.high - box.low;
  // The tolerance of the paper keeps flat boxes from having no volume, and the cubes from being too many.
  const double tolerance = 1e-3 * std::max({extent.x, extent.y, extent.z, 1.0});
  UniformGrid grid;
  grid.low = box.low - Point3{tolerance, tolerance, tolerance};
  const Point3 size = extent + Point3{2 * tolerance, 2 * tolerance, 2 * tolerance};
  grid.cell_size = scale * std::cbrt(size.x * size.y * size.z / static_cast<double>(std::max<std::size_t>(items, 1)));
  const auto count = [&](double s) { return std::max(1, static_cast<int>(std::ceil(s / grid.cell_size))); };
  grid.cells = {count(size.x), count(size.y), count(size.z)};
  return grid;
}

}  // namespace ccdt
