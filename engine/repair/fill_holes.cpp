#include "engine/repair/fill_holes.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/union_find.h"
#include "engine/plc/bent_facets.h"
#include "engine/plc/edge_table.h"
#include "engine/repair/equal_triangles.h"
#include "engine/repair/open_loops.h"

namespace ccdt::repair {
namespace {

using plc::EdgeTable;

/// Of the area of all triangles: nothing greater is taken for a flap.
constexpr double largest_flap = 0.5;

/// The triangle at an open edge.
std::uint32_t triangle_at(const EdgeTable& edges, VertexId a, VertexId b) {
  return plc::triangle_of(edges.sides_around(edges.find(a, b))[0]);
}

bool is_closed_by_an_edge(const std::vector<VertexId>& chain, const EdgeTable& edges, Rims which) {
  const std::uint32_t e = edges.find(chain.front(), chain.back());
  return chain.size() > 2 && e != EdgeTable::none && (which == Rims::all || edges.sides_around(e).size() == 2);
}

std::vector<std::vector<VertexId>> find_rims(const EdgeTable& edges, Rims which) {
  OpenEdges rims = find_open_edges(edges);
  for (std::vector<VertexId>& chain : rims.chains)
    if (is_closed_by_an_edge(chain, edges, which)) rims.loops.push_back(std::move(chain));
  return std::move(rims.loops);
}

bool is_loose(std::uint32_t triangle, const EdgeTable& edges) {
  return std::ranges::all_of(edges.edges_of[triangle],
                             [&](std::uint32_t e) { return edges.sides_around(e).size() == 1; });
}

/// The triangles of a polygon; none if it cannot be triangulated.
std::vector<plc::VertexTriple> triangulate(std::span<const Point3> points, std::span<const VertexId> corners) {
  plc::InputPlc input;
  for (const VertexId v : corners) input.vertices.push_back(points[v]);
  plc::PolygonFacet facet;
  facet.polygons.resize(1);
  facet.polygons[0].resize(corners.size());
  std::iota(facet.polygons[0].begin(), facet.polygons[0].end(), 0u);
  input.polygon_facets.push_back(std::move(facet));
  std::vector<plc::VertexTriple> triangles;
  try {
    if (auto bent = plc::triangulate_bent_facets(input)) input = std::move(*bent);
    const plc::UncheckedPlc gathered = plc::gather_plc(input);
    // The corners are different, and the grid of a part is finer than that of the whole.
    for (const auto& [a, b, c] : gathered.triangles.corners) triangles.push_back({corners[a], corners[b], corners[c]});
  } catch (const InputError&) {
    triangles.clear();
  }
  return triangles;
}

/// Do the triangles have the same orientation as the surface around them?
bool fits(const std::vector<plc::VertexTriple>& filling, const plc::TriangleSet& triangles, const EdgeTable& edges,
          VertexId a, VertexId b) {
  const std::uint32_t neighbor = triangle_at(edges, a, b);
  const bool along = plc::runs_along(triangles.corners[neighbor], a, b);
  return std::ranges::none_of(
      filling, [&](const plc::VertexTriple& t) { return along ? plc::runs_along(t, a, b) : plc::runs_along(t, b, a); });
}

}  // namespace

std::size_t remove_flaps(plc::UncheckedPlc& soup) {
  std::size_t removed = 0;
  while (true) {
    const EdgeTable edges = plc::make_edge_table(soup.triangles.corners);
    const OpenEdges rims = find_open_edges(edges);
    UnionFind parts(soup.triangles.size());
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      if (const auto sides = edges.sides_around(e); sides.size() == 2)
        parts.join(plc::triangle_of(sides[0]), plc::triangle_of(sides[1]));
    std::vector<double> area(soup.triangles.size(), 0);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
      area[parts.find(t)] += length(area_vector(plc::points_of(soup.plc.vertices, soup.triangles.corners[t])));
    const double most = largest_flap * std::accumulate(area.begin(), area.end(), 0.0);
    std::vector<char> is_flap(soup.triangles.size(), 0);
    for (const auto& chain : rims.chains) {
      if (is_closed_by_an_edge(chain, edges, Rims::of_holes)) continue;
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const std::uint32_t part = parts.find(triangle_at(edges, chain[i], chain[i + 1]));
        if (area[part] <= most) is_flap[part] = 1;
      }
    }
    std::vector<char> is_kept(soup.triangles.size(), 1);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
      is_kept[t] = is_flap[parts.find(t)] == 0 && !is_loose(t, edges);
    const auto flaps = static_cast<std::size_t>(std::ranges::count(is_kept, 0));
    if (flaps == 0 || flaps == soup.triangles.size()) return removed;
    removed += flaps;
    keep_triangles(is_kept, soup.triangles);
  }
}

HoleCounts fill_holes(plc::UncheckedPlc& soup, Rims which) {
  const EdgeTable edges = plc::make_edge_table(soup.triangles.corners);
  HoleCounts counts;
  const plc::TriangleSet around = soup.triangles;
  for (const std::vector<VertexId>& loop : find_rims(edges, which)) {
    std::vector<plc::VertexTriple> filling = triangulate(soup.plc.vertices, loop);
    if (filling.empty()) {
      ++counts.left;
      continue;
    }
    const bool is_right = fits(filling, around, edges, loop[0], loop[1]);
    const std::uint32_t neighbor = triangle_at(edges, loop[0], loop[1]);
    for (const auto& [a, b, c] : filling)
      soup.triangles.add(is_right ? plc::VertexTriple{a, b, c} : plc::VertexTriple{a, c, b}, around.markers[neighbor],
                         around.numbers[neighbor]);
    ++counts.filled;
    counts.triangles += filling.size();
  }
  return counts;
}

}  // namespace ccdt::repair
