#include <algorithm>
#include <utility>

#include "engine/planar/topology.h"
#include "engine/planar/triangulation.h"

namespace ccdt::planar {
namespace {

/// The sides of some triangles, found by direction.
class SidesByDirection {
 public:
  SidesByDirection(const PlanarTriangulation& t, const std::vector<std::uint32_t>& triangles) {
    sides_.reserve(3 * triangles.size());
    for (std::uint32_t triangle : triangles) {
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const PlanarSide s{triangle, corner};
        sides_.emplace_back(directed_key(edge_start(t, s), edge_end(t, s)), pack(s));
      }
    }
    std::sort(sides_.begin(), sides_.end());
  }

  std::optional<PlanarSide> find(VertexId from, VertexId to) const {
    const PlanarMap::Key key = directed_key(from, to);
    const auto at = std::lower_bound(sides_.begin(), sides_.end(), std::pair(key, std::uint32_t{0}));
    if (at == sides_.end() || at->first != key) return std::nullopt;
    return unpack(at->second);
  }

 private:
  std::vector<std::pair<PlanarMap::Key, std::uint32_t>> sides_;
};

struct BorderEdge {
  VertexId from, to;  ///< with the channel on its left
  Beyond beyond;
};

}  // namespace

void replace_channel(PlanarTriangulation& t, const std::vector<std::uint32_t>& channel,
                     const std::vector<PlanarSide>& border, const std::vector<std::array<VertexId, 3>>& triangles) {
  std::vector<BorderEdge> edges;
  edges.reserve(border.size());
  for (PlanarSide s : border) edges.push_back({edge_start(t, s), edge_end(t, s), beyond(t, s)});

  for (std::size_t i = 0; i < channel.size(); ++i) {
    set_corners(t, channel[i], triangles[i][0], triangles[i][1], triangles[i][2]);
  }
  const SidesByDirection sides(t, channel);
  for (std::uint32_t triangle : channel) {
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const PlanarSide s{triangle, corner};
      const std::optional<PlanarSide> other = sides.find(edge_end(t, s), edge_start(t, s));
      if (other) join(t, s, *other, false);
    }
  }
  for (const BorderEdge& edge : edges) {
    const PlanarSide s = *sides.find(edge.from, edge.to);
    if (sides.find(edge.to, edge.from)) {
      // A spike: an edge that is not crossed but has the channel on both its sides. Only its constraint must be kept.
      planar_set_constrained(t, s, edge.beyond.constrained);
    } else {
      attach(t, s, edge.beyond);
    }
  }
}

}  // namespace ccdt::planar
