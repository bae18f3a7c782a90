#include "engine/plc/find_segments.h"

#include "engine/plc/sort_around_edges.h"

namespace ccdt {

namespace {

bool is_grazeable(std::span<const Point3> vertices, const TriangleSet& triangles, const EdgeTable& edges,
                  const RegionMap& map, std::uint32_t e) {
  const auto [a, b] = edges.ends[e];
  const auto around = edges.around(e);
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Corners &s = triangles.corners[around[i]], &t = triangles.corners[around[(i + 1) % around.size()]];
    const RegionId sector = map.of(around[i], runs_along(s, a, b));
    if (!map.regions[sector].inside) continue;
    const Turn angle = around.size() == 1 ? Turn::above_180
                                          : turn_about(vertices[a], vertices[b], vertices[apex_over(s, a, b)],
                                                       vertices[apex_over(t, a, b)]);
    if (angle == Turn::exactly_180 || angle == Turn::above_180) return true;
  }
  return false;
}

}  // namespace

std::vector<Segment> find_segments(std::span<const Point3> vertices, const TriangleSet& triangles,
                                   const EdgeTable& edges, const FacetPatches& facets, const SegmentSet& input,
                                   std::span<const std::uint32_t> segment_of, std::span<const std::uint32_t> loose,
                                   const RegionMap& map, const VerticalRays& rays) {
  std::vector<Segment> segments;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    if (facets.is_inner_edge[e]) continue;
    const int marker = segment_of[e] == EdgeTable::none ? 0 : input.markers[segment_of[e]];
    segments.push_back({edges.ends[e], marker, is_grazeable(vertices, triangles, edges, map, e)});
  }
  for (const std::uint32_t s : loose) {
    const auto& ends = input.ends[s];
    const RegionId region = region_at(map, rays, RayStart::middle_of(vertices[ends[0]], vertices[ends[1]]));
    segments.push_back({ends, input.markers[s], map.regions[region].inside});
  }
  return segments;
}

}  // namespace ccdt
