#include "engine/delaunay/vertex_grid.h"

#include <algorithm>
#include <limits>

namespace ccdt {
namespace {

void add_block(VertexGrid& g, const UniformGrid::CellIndex& from) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  GridBlock block;
  block.from = from;
  for (int i = 0; i < 3; ++i) block.to[i] = std::min(from[i] + GridBlock::side, g.grid.cells[i]) - 1;
  Point3 low{inf, inf, inf}, high{-inf, -inf, -inf};
  for (int z = block.from[2]; z <= block.to[2]; ++z) {
    for (int y = block.from[1]; y <= block.to[1]; ++y) {
      const std::size_t row = g.grid.number({0, y, z});
      for (std::uint32_t v = g.first[row + block.from[0]]; v < g.first[row + block.to[0] + 1]; ++v) {
        const Point3& p = g.vertices[v].point;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
    }
  }
  if (low.x > high.x) return;
  const double hair = 1e-15 * std::max({g.extent.x, g.extent.y, g.extent.z});
  block.centre = 0.5 * (low + high);
  block.half = 0.5 * (high - low) + Point3{hair, hair, hair};
  g.blocks.push_back(block);
}

}  // namespace

VertexGrid make_vertex_grid(std::span<const DelaunayVertex> vertices, double scale) {
  VertexGrid g;
  if (vertices.empty()) return g;
  Point3 low = vertices[0].point, high = low;
  for (const DelaunayVertex& v : vertices) {
    low = {std::min(low.x, v.point.x), std::min(low.y, v.point.y), std::min(low.z, v.point.z)};
    high = {std::max(high.x, v.point.x), std::max(high.y, v.point.y), std::max(high.z, v.point.z)};
  }
  g.extent = high - low;
  g.grid = make_uniform_grid({{}, g.extent}, vertices.size(), scale);
  IndexLists lists = make_index_lists(g.grid.size(), [&](const auto& emit) {
    for (std::uint32_t v = 0; v < vertices.size(); ++v) emit(g.grid.number(g.grid.cell_at(vertices[v].point - low)), v);
  });
  g.first = std::move(lists.first);
  g.vertices.reserve(vertices.size());
  for (const std::uint32_t v : lists.items) g.vertices.push_back({vertices[v].point - low, vertices[v].rank, v});
  for (int z = 0; z < g.grid.cells[2]; z += GridBlock::side)
    for (int y = 0; y < g.grid.cells[1]; y += GridBlock::side)
      for (int x = 0; x < g.grid.cells[0]; x += GridBlock::side) add_block(g, {x, y, z});
  return g;
}

}  // namespace ccdt
