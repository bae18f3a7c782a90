#include "engine/plc/find_regions.h"

#include "engine/base/union_find.h"

namespace ccdt {

namespace {

std::uint32_t side(std::uint32_t triangle, bool above) {
  return 2 * triangle + (above ? 0 : 1);
}

// Counterclockwise about an edge from its smaller end to its greater, the sector that follows a triangle is on its
// upper side if the triangle runs along the edge that way; the sector before it is on the other.
void join_through_sectors(const TriangleSet& triangles, const EdgeTable& edges, const FacetPatches& facets,
                          UnionFind& sides) {
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const auto around = edges.around(e);
    if (facets.is_inner_edge[e]) {  // oriented alike; a tiny fold between them has no say
      sides.join(side(around[0], true), side(around[1], true));
      sides.join(side(around[0], false), side(around[1], false));
      continue;
    }
    for (std::size_t i = 0; i < around.size(); ++i) {
      const std::uint32_t s = around[i], t = around[(i + 1) % around.size()];
      const auto [a, b] = edges.ends[e];
      sides.join(side(s, runs_along(triangles.corners[s], a, b)), side(t, !runs_along(triangles.corners[t], a, b)));
    }
  }
}

UnionFind components_of(const TriangleSet& triangles, const EdgeTable& edges) {
  UnionFind components(triangles.size());
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    for (const std::uint32_t t : edges.around(e)) components.join(edges.around(e)[0], t);
  return components;
}

}  // namespace

// That one ray a component suffices: the sides of one component that see the same connected part of space, seen alone,
// are all joined already. So on the way from a component up to whatever encloses it, everything passed joins the
// outermost side of what it passes.
RegionMap find_regions(const TriangleSet& triangles, std::span<const Point3> vertices, const EdgeTable& edges,
                       const FacetPatches& facets, const VerticalRays& rays) {
  const std::uint32_t infinity = 2 * triangles.size();
  UnionFind sides(infinity + 1), components = components_of(triangles, edges);
  join_through_sectors(triangles, edges, facets, sides);

  std::vector<std::uint32_t> outer_side(triangles.size());  // of the first triangle of each component
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (components.find(t) != t) continue;
    const auto [a, b, c] = triangles.corners[t];
    std::uint32_t left = side(t, rays.leaves_above(t));
    outer_side[t] = left;
    for (const RayHit& hit : rays.shoot(RayStart::centroid_of(vertices[a], vertices[b], vertices[c]), t)) {
      sides.join(left, side(hit.triangle, hit.enters_above));
      left = side(hit.triangle, !hit.enters_above);
      if (components.find(hit.triangle) == t) outer_side[t] = left;
    }
    sides.join(left, infinity);
  }

  RegionMap map;
  std::vector<RegionId> region_of_set(infinity + 1);
  region_of_set[sides.find(infinity)] = RegionId(0u);
  map.regions.resize(1);
  map.of_side.resize(infinity);
  for (std::uint32_t s = 0; s < infinity; ++s) {
    RegionId& region = region_of_set[sides.find(s)];
    if (region.is_none()) {
      region = RegionId(map.regions.size());
      map.regions.emplace_back();
    }
    map.of_side[s] = region;
  }
  map.around.resize(map.regions.size());
  for (std::uint32_t s = 0; s < infinity; ++s) {
    const RegionId around = map.of_side[outer_side[components.find(s / 2)]];
    if (map.of_side[s] != around) map.around[map.of_side[s]] = around;
  }
  return map;
}

RegionId region_at(const RegionMap& map, const VerticalRays& rays, const RayStart& point) {
  const std::vector<RayHit> hits = rays.shoot(point);
  return hits.empty() ? RegionId(0u) : map.of(hits.front().triangle, hits.front().enters_above);
}

}  // namespace ccdt
