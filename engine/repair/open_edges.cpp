#include "engine/repair/open_edges.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace ccdt::repair {
namespace {

/// The open edges, and for each of their vertices the edges at it.
struct OpenGraph {
  std::vector<std::array<VertexId, 2>> ends;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> at;  ///< by vertex
  std::vector<char> is_used;                                         ///< of each edge

  explicit OpenGraph(const plc::EdgeTable& edges) {
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      if (edges.sides_around(e).size() != 1) continue;
      for (const VertexId v : edges.ends[e]) at[v].push_back(static_cast<std::uint32_t>(ends.size()));
      ends.push_back(edges.ends[e]);
    }
    is_used.assign(ends.size(), 0);
  }

  bool is_end(VertexId v) const {
    const auto there = at.find(v);
    return std::ranges::count_if(there->second, [&](std::uint32_t e) { return is_used[e] == 0; }) % 2 != 0;
  }
  /// Uses an edge at the vertex; returns its other end, or none if all are used.
  VertexId follow(VertexId v) {
    for (const std::uint32_t e : at.find(v)->second) {
      if (is_used[e]) continue;
      is_used[e] = 1;
      return ends[e][0] == v ? ends[e][1] : ends[e][0];
    }
    return {};
  }
};

/// Walks on until no edge is left. Whenever the walk meets itself, it leaves a loop behind.
void walk(VertexId start, OpenGraph& graph, OpenEdges& found) {
  std::vector<VertexId> path = {start};
  std::unordered_map<std::uint32_t, std::size_t> place_of = {{start, 0}};
  for (VertexId v = graph.follow(start); !v.is_none(); v = graph.follow(v)) {
    const auto [place, is_new] = place_of.try_emplace(v, path.size());
    if (is_new) {
      path.push_back(v);
      continue;
    }
    const auto begin = path.begin() + static_cast<std::ptrdiff_t>(place->second);
    found.loops.emplace_back(begin, path.end());
    for (auto met = begin + 1; met != path.end(); ++met) place_of.erase(*met);
    path.erase(begin + 1, path.end());
  }
  if (path.size() > 1) found.chains.push_back(std::move(path));
}

}  // namespace

OpenEdges find_open_edges(const plc::EdgeTable& edges) {
  OpenGraph graph(edges);
  OpenEdges found;
  for (const bool from_ends : {true, false})
    for (const auto& ends : graph.ends)
      for (const VertexId v : ends)
        if (!from_ends || graph.is_end(v)) walk(v, graph, found);
  return found;
}

std::uint32_t triangle_at(const plc::EdgeTable& edges, VertexId a, VertexId b) {
  return plc::triangle_of(edges.sides_around(edges.find(a, b))[0]);
}

bool is_closed_by_an_edge(const std::vector<VertexId>& chain, const plc::EdgeTable& edges, Rims which) {
  const std::uint32_t e = edges.find(chain.front(), chain.back());
  return chain.size() > 2 && e != none && (which == Rims::all || edges.sides_around(e).size() == 2);
}

}  // namespace ccdt::repair
