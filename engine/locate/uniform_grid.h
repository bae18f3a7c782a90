#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/numbers/point.h"
#include "engine/plc/box_tree.h"

namespace ccdt {

/// The cells of a uniform grid over a box (paper, section 4), without contents.
struct UniformGrid {
  Point3 low;
  double cell_size = 1;
  std::array<int, 3> cells{1, 1, 1};

  using CellIndex = std::array<int, 3>;

  /// The cell that holds the point; points outside count to the nearest cell.
  CellIndex cell_at(const Point3& p) const {
    return {axis_cell(p.x - low.x, 0), axis_cell(p.y - low.y, 1), axis_cell(p.z - low.z, 2)};
  }
  std::size_t number(const CellIndex& c) const {
    return (static_cast<std::size_t>(c[2]) * cells[1] + c[1]) * cells[0] + c[0];
  }
  std::size_t size() const { return static_cast<std::size_t>(cells[0]) * cells[1] * cells[2]; }
  Point3 centre(const CellIndex& c) const {
    return {low.x + (c[0] + 0.5) * cell_size, low.y + (c[1] + 0.5) * cell_size, low.z + (c[2] + 0.5) * cell_size};
  }
  /// A little larger than the cell, for the roundings of `cell_at`.
  ClosedBox box(const CellIndex& c) const {
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

/// The grid of the paper: about as many cubes as there are vertices or faces, whichever are more.
///
/// \param scale  factor of the paper's cell size; a tenth of it means a thousand times the cells
UniformGrid make_uniform_grid(const Point3& low, const Point3& high, std::size_t items, double scale = 1);

/// Lists by cell in two flat arrays: the items of cell c are items[first[c] .. first[c + 1]).
struct CellLists {
  std::vector<std::uint32_t> first, items;

  std::span<const std::uint32_t> of(std::size_t cell) const {
    return {items.data() + first[cell], items.data() + first[cell + 1]};
  }
};

/// Builds the lists from `visit_pairs(emit)`, which calls emit(cell, item) for each pair, twice over in the same order.
template <class VisitPairs>
CellLists make_cell_lists(std::size_t cells, const VisitPairs& visit_pairs) {
  CellLists lists;
  lists.first.assign(cells + 1, 0);
  visit_pairs([&](std::size_t cell, std::uint32_t) { ++lists.first[cell + 1]; });
  for (std::size_t c = 0; c < cells; ++c) lists.first[c + 1] += lists.first[c];
  lists.items.resize(lists.first[cells]);
  std::vector<std::uint32_t> next(lists.first.begin(), lists.first.end() - 1);
  visit_pairs([&](std::size_t cell, std::uint32_t item) { lists.items[next[cell]++] = item; });
  return lists;
}

}  // namespace ccdt
