#include "engine/locate/grid_locator.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ccdt::locate {
namespace {

/// Calls visit(cell) for every cell of the triangle's box that its plane comes near.
template <class Visit>
void for_each_cell_of_triangle(const UniformGrid& grid, const Point3& a, const Point3& b, const Point3& c,
                               const Visit& visit) {
  const double slack = 1e-3 * grid.cell_size;
  const Point3 normal = cross(b - a, c - a);
  // How far a cell's corner can be from its center, along the normal.
  const double reach =
      (std::fabs(normal.x) + std::fabs(normal.y) + std::fabs(normal.z)) * (0.5 * grid.cell_size + slack) * (1 + 1e-9);
  const Box box = expanded(bounding_box(std::array{a, b, c}), slack);
  UniformGrid::for_each(grid.cell_at(box.low), grid.cell_at(box.high), [&](const UniformGrid::CellIndex& cell) {
    if (std::fabs(dot(normal, grid.center(cell) - a)) <= reach) visit(grid.number(cell));
  });
}

}  // namespace

GridLocator::GridLocator(std::span<const delaunay::DelaunayVertex> vertices,
                         std::span<const std::array<VertexId, 3>> faces, double scale)
    : grid_(make_uniform_grid(bounding_box(vertices), std::max(vertices.size(), faces.size()), scale)) {
  IndexLists by_cell = make_index_lists(grid_.size(), [&](const auto& emit) {
    for (std::uint32_t v = 0; v < vertices.size(); ++v) emit(grid_.number(grid_.cell_at(vertices[v].point)), v);
  });
  for (const std::uint32_t v : by_cell.items) vertices_.push_back({vertices[v].point, vertices[v].rank, v});
  first_vertex_ = std::move(by_cell.first);
  faces_ = make_index_lists(grid_.size(), [&](const auto& emit) {
    for (std::uint32_t f = 0; f < faces.size(); ++f)
      for_each_cell_of_triangle(grid_, vertices[faces[f][0]].point, vertices[faces[f][1]].point,
                                vertices[faces[f][2]].point, [&](std::size_t cell) { emit(cell, f); });
  });
}

}  // namespace ccdt::locate
