#include "engine/delaunay/vertex_grid.h"

#include <algorithm>

namespace ccdt {

VertexGrid make_vertex_grid(std::span<const DelaunayVertex> vertices, double scale) {
  VertexGrid g;
  if (vertices.empty()) return g;
  Point3 low = vertices[0].point, high = low;
  for (const DelaunayVertex& v : vertices) {
    low = {std::min(low.x, v.point.x), std::min(low.y, v.point.y), std::min(low.z, v.point.z)};
    high = {std::max(high.x, v.point.x), std::max(high.y, v.point.y), std::max(high.z, v.point.z)};
  }
  g.extent = high - low;
  g.grid = make_uniform_grid({}, g.extent, vertices.size(), scale);
  CellLists lists = make_cell_lists(g.grid.size(), [&](const auto& emit) {
    for (std::uint32_t v = 0; v < vertices.size(); ++v) emit(g.grid.number(g.grid.cell_at(vertices[v].point - low)), v);
  });
  g.first = std::move(lists.first);
  g.vertices.reserve(vertices.size());
  for (const std::uint32_t v : lists.items) g.vertices.push_back({vertices[v].point - low, vertices[v].rank, v});
  return g;
}

}  // namespace ccdt
