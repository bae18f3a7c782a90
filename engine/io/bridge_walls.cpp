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

/// Pairs of facets that stand on a bridge, by their places in the list.
std::vector<std::array<std::size_t, 2>> find_walls(const plc::InputPlc& surface, const std::set<Edge>& bridges) {
  std::vector<std::array<std::size_t, 2>> walls;
  std::map<Loop, std::size_t> unpaired;
  for (std::size_t i = 0; i < surface.polygon_facets.size(); ++i) {
    if (!plc::is_one_loop(surface.polygon_facets[i])) continue;
    Loop loop = loop_of(surface, surface.polygon_facets[i]);
    const std::set<Edge> edges = edges_of(loop);
    const auto is_on_bridge = [&](const Edge& e) {
      return bridges.contains(e) && !edges.contains({e.second, e.first});
    };
    if (std::ranges::none_of(edges, is_on_bridge)) continue;
    const Loop there = rotated(loop);
    std::ranges::reverse(loop);
    if (const auto back = unpaired.find(rotated(loop)); back != unpaired.end()) {
      walls.push_back({back->second, i});
      unpaired.erase(back);
    } else {
      unpaired.insert({there, i});
    }
  }
  return walls;
}

}  // namespace

void drop_bridge_walls(plc::InputPlc& surface) {
  if (surface.inside != plc::InputPlc::Inside::even_odd) return;
  const std::set<Edge> bridges = find_bridges(surface);
  if (bridges.empty()) return;
  std::set<std::size_t> dropped;
  std::string numbers;
  for (const auto& [one, other] : find_walls(surface, bridges)) {
    dropped.insert({one, other});
    numbers += (numbers.empty() ? "" : ", ") + std::to_string(surface.polygon_facets[one].number) + " and " +
               std::to_string(surface.polygon_facets[other].number);
  }
  if (dropped.empty()) return;
  std::size_t next = 0;
  std::erase_if(surface.polygon_facets, [&](const plc::PolygonFacet&) { return dropped.contains(next++); });
  surface.notes.push_back("two facets on the bridge of a polygon bound nothing and were left out: facets " + numbers);
}

}  // namespace ccdt::io
