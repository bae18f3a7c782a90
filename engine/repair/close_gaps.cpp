#include "engine/repair/close_gaps.h"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <ranges>
#include <span>
#include <vector>

#include "engine/base/box.h"
#include "engine/base/union_find.h"
#include "engine/geometry/box_tree.h"
#include "engine/geometry/closest_point.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/gather_parts.h"

namespace ccdt::repair {
namespace {

using plc::EdgeTable;

/// The open edges of a soup, and their vertices.
struct OpenRims {
  std::vector<std::uint32_t> edges;
  std::vector<VertexId> vertices;
  std::vector<double> reach;  ///< by vertex: the widest gap that may be closed there
};

/// No reach is more than half of the shortest open edge at its vertex, so that triangles do not collapse.
OpenRims find_rims(std::span<const Point3> points, const EdgeTable& edges, double width) {
  OpenRims rims;
  std::vector<double> reach(points.size(), 0);
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    if (edges.sides_around(e).size() != 1) continue;
    rims.edges.push_back(e);
    const double half = 0.5 * length(points[edges.ends[e][1]] - points[edges.ends[e][0]]);
    for (const VertexId v : edges.ends[e]) reach[v] = std::min(reach[v] == 0 ? width : reach[v], half);
  }
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    if (reach[v] == 0) continue;
    rims.vertices.push_back(VertexId(v));
    rims.reach.push_back(reach[v]);
  }
  return rims;
}

/// Its boxes hold everything within reach of the vertices.
BoxTree tree_of(std::span<const Point3> points, const OpenRims& rims) {
  return {std::views::iota(std::size_t{0}, rims.vertices.size()),
          [&](std::size_t i) { return expanded(box_of(points[rims.vertices[i]]), rims.reach[i]); }};
}

/// Two vertices of rims, by their numbers there.
struct Candidate {
  double squared_distance;
  std::uint32_t first, second;

  auto operator<=>(const Candidate&) const = default;
};

/// The pairs within reach of each other, the nearest first.
std::vector<Candidate> find_candidates(std::span<const Point3> points, const OpenRims& rims) {
  std::vector<Candidate> candidates;
  tree_of(points, rims).for_each_pair([&](std::uint32_t i, std::uint32_t j) {
    const double squared = squared_length(points[rims.vertices[j]] - points[rims.vertices[i]]);
    const double most = std::min(rims.reach[i], rims.reach[j]);
    if (squared <= most * most) candidates.push_back({squared, i, j});
  });
  std::ranges::sort(candidates);
  return candidates;
}

/// Vertices move to the first one of their set, so sets are joined only if their first ones are near each other.
std::vector<VertexId> merge_vertices(plc::UncheckedPlc& soup, double width) {
  const std::vector<Point3>& points = soup.plc.vertices;
  const OpenRims rims = find_rims(points, plc::make_edge_table(soup.triangles.corners), width);
  std::vector<double> reach(points.size(), 0);
  for (std::size_t i = 0; i < rims.vertices.size(); ++i) reach[rims.vertices[i]] = rims.reach[i];
  UnionFind sets(points.size());
  std::vector<VertexId> merged;
  for (const Candidate& candidate : find_candidates(points, rims)) {
    const std::uint32_t a = sets.find(rims.vertices[candidate.first]), b = sets.find(rims.vertices[candidate.second]);
    const double most = std::min(reach[a], reach[b]);
    if (a == b || squared_length(points[b] - points[a]) > most * most) continue;
    reach[sets.join(a, b)] = most;
    merged.emplace_back(std::max(a, b));
  }
  const auto follow = [&](VertexId& v) { v = VertexId(sets.find(v)); };
  for (plc::VertexTriple& corners : soup.triangles.corners) std::ranges::for_each(corners, follow);
  for (auto& ends : soup.segments.ends) std::ranges::for_each(ends, follow);
  return merged;
}

/// A vertex beside an open edge.
struct Beside {
  std::uint32_t edge;
  double along;  ///< the squared distance from the edge's first end
  VertexId vertex;

  auto operator<=>(const Beside&) const = default;
};

/// The vertices beside edges, in order along each edge.
std::vector<Beside> find_vertices_beside(std::span<const Point3> points, const plc::TriangleSet& triangles,
                                         const EdgeTable& edges, const OpenRims& rims) {
  const BoxTree tree = tree_of(points, rims);
  std::vector<Beside> found;
  for (const std::uint32_t e : rims.edges) {
    const Point3 &a = points[edges.ends[e][0]], &b = points[edges.ends[e][1]];
    const plc::VertexTriple& corners = triangles.corners[plc::triangle_of(edges.sides_around(e)[0])];
    tree.for_each_meeting(LineSegment{a, b - a}, [&](std::uint32_t i) {
      const VertexId v = rims.vertices[i];
      const Point3 nearest = closest_on_segment(points[v], a, b);
      if (plc::has_corner(corners, v) || nearest == a || nearest == b) return;
      if (squared_length(points[v] - nearest) <= rims.reach[i] * rims.reach[i])
        found.push_back({e, squared_length(nearest - a), v});
    });
  }
  std::ranges::sort(found);
  return found;
}

/// In each triangle that has open edges with vertices beside them, splits one of these edges.
std::size_t split_open_edges(plc::UncheckedPlc& soup, double width) {
  const EdgeTable edges = plc::make_edge_table(soup.triangles.corners);
  const OpenRims rims = find_rims(soup.plc.vertices, edges, width);
  const std::vector<Beside> beside = find_vertices_beside(soup.plc.vertices, soup.triangles, edges, rims);
  plc::TriangleSet& triangles = soup.triangles;
  std::vector<char> is_split(triangles.size(), 0);
  std::size_t split = 0;
  for (auto next = beside.begin(); next != beside.end();) {
    const std::uint32_t e = next->edge, t = plc::triangle_of(edges.sides_around(e)[0]);
    std::vector<VertexId> chain = {edges.ends[e][0]};
    for (; next != beside.end() && next->edge == e; ++next) chain.push_back(next->vertex);
    if (is_split[t]) continue;
    chain.push_back(edges.ends[e][1]);
    const plc::VertexTriple whole = triangles.corners[t];
    if (!plc::runs_along(whole, chain.front(), chain.back())) std::ranges::reverse(chain);
    const VertexId apex = plc::apex_over(whole, chain.front(), chain.back());
    triangles.corners[t] = {chain[0], chain[1], apex};
    for (std::size_t k = 1; k + 1 < chain.size(); ++k)
      triangles.add({chain[k], chain[k + 1], apex}, triangles.markers[t], triangles.numbers[t]);
    is_split[t] = 1;
    ++split;
  }
  return split;
}

}  // namespace

GapCounts close_gaps(plc::UncheckedPlc& soup, double width) {
  GapCounts counts;
  const auto drop_collapsed = [&] { plc::drop_triangles_without_area(soup.plc.vertices, soup.triangles); };
  counts.merged = merge_vertices(soup, width);
  if (!counts.merged.empty()) drop_collapsed();
  // Each triangle has three edges, and pieces of them may have further vertices beside them.
  constexpr int most_rounds = 8;
  for (int round = 0; round < most_rounds; ++round) {
    const std::size_t split = split_open_edges(soup, width);
    counts.split_edges += split;
    if (split == 0) break;
    drop_collapsed();
  }
  return counts;
}

}  // namespace ccdt::repair
