#include "engine/io/bridge_walls.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ccdt::io {

namespace {

using Corner = std::array<double, 3>;  // vertices may be repeated
using Loop = std::vector<Corner>;
using Edge = std::pair<Corner, Corner>;

Loop loop_of(const plc::InputPlc& surface, const plc::PolygonFacet& facet) {
  Loop loop;
  for (const std::uint32_t v : facet.polygons[0]) loop.push_back(as_array(surface.vertices[v]));
  return loop;
}

std::set<Edge> edges_of(const Loop& loop) {
  std::set<Edge> edges;
  for (std::size_t i = 0; i < loop.size(); ++i) edges.insert({loop[i], loop[(i + 1) % loop.size()]});
  return edges;
}

/// The edges along which an outline runs in both directions.
std::set<Edge> find_bridges(const plc::InputPlc& surface) {
  constexpr std::size_t least_corners = 8;  // a triangle within a triangle, and each end of the bridge once more
  std::set<Edge> bridges;
  for (const plc::PolygonFacet& facet : surface.polygon_facets) {
    if (!plc::is_one_loop(facet) || facet.polygons[0].size() < least_corners) continue;
    const std::set<Edge> edges = edges_of(loop_of(surface, facet));
    for (const auto& [a, b] : edges)
      if (edges.contains({b, a})) bridges.insert({a, b});
  }
  return bridges;
}

/// Begins with the least corner.
Loop rotated(Loop loop) {
  std::ranges::rotate(loop, std::ranges::min_element(loop));
  return loop;
}

}  // namespace

void drop_bridge_walls(plc::InputPlc& surface) {
  if (surface.inside != plc::InputPlc::Inside::even_odd) return;
  const std::set<Edge> bridges = find_bridges(surface);
  if (bridges.empty()) return;
  std::map<Loop, std::size_t> unpaired;
  std::vector<bool> dropped(surface.polygon_facets.size(), false);
  std::string numbers;
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    const plc::PolygonFacet& facet = surface.polygon_facets[i];
    if (!plc::is_one_loop(facet)) continue;
    Loop loop = loop_of(surface, facet);
    const std::set<Edge> edges = edges_of(loop);
    const auto is_on_bridge = [&](const Edge& e) {
      return bridges.contains(e) && !edges.contains({e.second, e.first});
    };
    if (std::ranges::none_of(edges, is_on_bridge)) continue;
    const Loop there = rotated(loop);
    std::ranges::reverse(loop);
    const auto back = unpaired.find(rotated(loop));
    if (back == unpaired.end()) {
      unpaired.insert({there, i});
      continue;
    }
    dropped[i] = dropped[back->second] = true;
    numbers += (numbers.empty() ? "" : ", ") + std::to_string(surface.polygon_facets[back->second].number) + " and " +
               std::to_string(facet.number);
    unpaired.erase(back);
  }
  if (numbers.empty()) return;
  std::size_t next = 0;
  std::erase_if(surface.polygon_facets, [&](const plc::PolygonFacet&) { return dropped[next++]; });
  surface.notes.push_back("two facets on the bridge of a polygon bound nothing and were left out: facets " + numbers);
}

}  // namespace ccdt::io
