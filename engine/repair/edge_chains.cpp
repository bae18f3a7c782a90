#include "engine/repair/edge_chains.h"

#include <algorithm>
#include <tuple>

#include "engine/geometry/integer_points.h"

namespace ccdt::repair {

EdgeChains::EdgeChains(std::span<const Point3> vertices, std::vector<AtEdge> on_edges) {
  for_each_edge_group(on_edges, [&](std::span<const AtEdge> group) {
    const VertexId a(group[0].edge >> 32), b(static_cast<std::uint32_t>(group[0].edge));
    const auto begin = static_cast<std::uint32_t>(vertices_.size());
    for (const AtEdge& at : group) {
      const VertexId v(at.value);
      if (v != a && v != b && (vertices_.size() == begin || vertices_.back() != v)) vertices_.push_back(v);
    }
    if (vertices_.size() == begin) return;
    // Rounding does not change the order of points along the axis. Points that it makes equal get a fixed order.
    const Point3 along = vertices[b] - vertices[a];
    const auto axis = static_cast<std::size_t>(dominant_axis(along));
    const double sense = as_array(along)[axis] < 0 ? -1 : 1;
    std::sort(vertices_.begin() + begin, vertices_.end(), [&](VertexId u, VertexId v) {
      const double x = sense * as_array(vertices[u])[axis], y = sense * as_array(vertices[v])[axis];
      return std::tie(x, u) < std::tie(y, v);
    });
    places_.set(group[0].edge, {begin, static_cast<std::uint32_t>(vertices_.size())});
  });
}

std::vector<VertexId> EdgeChains::between(VertexId a, VertexId b) const {
  const auto [begin, end] = places_.get(edge_key(a, b), {0, 0});
  std::vector<VertexId> chain(vertices_.begin() + begin, vertices_.begin() + end);
  if (b < a) std::ranges::reverse(chain);
  return chain;
}

}  // namespace ccdt::repair
