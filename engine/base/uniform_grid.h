#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/base/box.h"
#include "engine/base/portable_math.h"

namespace ccdt {

/// The cells of a uniform grid over a box (paper, section 4), without contents.
struct UniformGrid {
  Point3 low;
  double cell_size = 1;
  std::array<int, 3> cells{1, 1, 1};

  using CellIndex = std::array<int, 3>;

  /// The cell that holds the point; points outside belong to the nearest cell.
  CellIndex cell_at(const Point3& p) const {
    return {axis_cell(p.x - low.x, 0), axis_cell(p.y - low.y, 1), axis_cell(p.z - low.z, 2)};
  }
  std::size_t number(const CellIndex& c) const {
    return (static_cast<std::size_t>(c[2]) * cells[1] + c[1]) * cells[0] + c[0];
  }
  std::size_t size() const { return static_cast<std::size_t>(cells[0]) * cells[1] * cells[2]; }
  Point3 center(const CellIndex& c) const {
    return {low.x + (c[0] + 0.5) * cell_size, low.y + (c[1] + 0.5) * cell_size, low.z + (c[2] + 0.5) * cell_size};
  }
  /// A little larger than the cell, to cover rounding in `cell_at`.
  Box box(const CellIndex& c) const {
    const double slack = 1e-6 * cell_size, side = cell_size + 2 * slack;
    const Point3 corner{low.x + c[0] * cell_size - slack, low.y + c[1] * cell_size - slack,
                        low.z + c[2] * cell_size - slack};
    return {corner, corner + Point3{side, side, side}};
  }

  /// Calls visit(cell) for all cells from `from` to `to`, both included.
  template <class Visit>
  static void for_each(const CellIndex& from, const CellIndex& to, const Visit& visit) {
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y)
        for (int x = from[0]; x <= to[0]; ++x) visit(CellIndex{x, y, z});
  }

 private:
  int axis_cell(double offset, int axis) const {
    const double c = std::floor(offset / cell_size);
    return c <= 0 ? 0 : c >= cells[axis] - 1 ? cells[axis] - 1 : static_cast<int>(c);
  }
};

/// The grid of the paper: about as many cubes as vertices or faces, whichever is larger.
///
/// \param scale  factor of the paper's cell size; a tenth of it means a thousand times the cells
inline UniformGrid make_uniform_grid(const Box& box, std::size_t items, double scale = 1) {
  const Point3 extent = box.high - box.low;
  // The tolerance of the paper avoids flat boxes without volume, and too many cubes.
  const double tolerance = 1e-3 * std::max({extent.x, extent.y, extent.z, 1.0});
  UniformGrid grid;
  grid.low = box.low - Point3{tolerance, tolerance, tolerance};
  const Point3 size = extent + Point3{2 * tolerance, 2 * tolerance, 2 * tolerance};
  grid.cell_size =
      scale * portable::cube_root(size.x * size.y * size.z / static_cast<double>(std::max<std::size_t>(items, 1)));
  const auto count = [&](double s) { return std::max(1, static_cast<int>(std::ceil(s / grid.cell_size))); };
  grid.cells = {count(size.x), count(size.y), count(size.z)};
  return grid;
}

}  // namespace ccdt
