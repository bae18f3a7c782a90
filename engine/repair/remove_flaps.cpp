#include "engine/repair/remove_flaps.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "engine/base/union_find.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/gather_parts.h"
#include "engine/repair/open_edges.h"

namespace ccdt::repair {
namespace {

using plc::EdgeTable;

/// As a share of the area of all triangles: nothing larger is taken for a flap.
constexpr double largest_flap = 0.5;

bool is_loose(std::uint32_t triangle, const EdgeTable& edges) {
  return std::ranges::all_of(edges.edges_of[triangle],
                             [&](std::uint32_t e) { return edges.sides_around(e).size() == 1; });
}

/// Triangles that are connected by edges of two triangles.
UnionFind find_patches(const plc::TriangleSet& triangles, const EdgeTable& edges) {
  UnionFind patches(triangles.size());
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (const auto sides = edges.sides_around(e); sides.size() == 2)
      patches.join(plc::triangle_of(sides[0]), plc::triangle_of(sides[1]));
  return patches;
}

/// By the first triangle of a patch: is it a flap?
std::vector<char> find_flaps(const plc::UncheckedPlc& soup, const EdgeTable& edges, UnionFind& patches) {
  std::vector<double> area(soup.triangles.size(), 0);
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
    area[patches.find(t)] += length(area_vector(plc::points_of(soup.plc.vertices, soup.triangles.corners[t])));
  const double most = largest_flap * std::accumulate(area.begin(), area.end(), 0.0);
  std::vector<char> is_flap(soup.triangles.size(), 0);
  for (const std::vector<VertexId>& chain : find_open_edges(edges).chains) {
    if (is_closed_by_an_edge(chain, edges, Rims::of_holes)) continue;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const std::uint32_t patch = patches.find(triangle_at(edges, chain[i], chain[i + 1]));
      if (area[patch] <= most) is_flap[patch] = 1;
    }
  }
  return is_flap;
}

}  // namespace

std::size_t remove_flaps(plc::UncheckedPlc& soup) {
  std::size_t removed = 0;
  while (true) {
    const EdgeTable edges = plc::make_edge_table(soup.triangles.corners);
    UnionFind patches = find_patches(soup.triangles, edges);
    const std::vector<char> is_flap = find_flaps(soup, edges, patches);
    std::vector<char> is_kept(soup.triangles.size(), 1);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
      is_kept[t] = is_flap[patches.find(t)] == 0 && !is_loose(t, edges);
    const auto flaps = static_cast<std::size_t>(std::ranges::count(is_kept, 0));
    if (flaps == 0 || flaps == soup.triangles.size()) return removed;
    removed += flaps;
    plc::keep_triangles(is_kept, soup.triangles);
  }
}

}  // namespace ccdt::repair
