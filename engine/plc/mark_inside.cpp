#include <algorithm>
#include <string>

#include "engine/base/errors.h"
#include "engine/plc/find_regions.h"
#include "engine/plc/refusals.h"

namespace ccdt {

namespace {

// By reference throughout: GCC 12 at -O3 forgets what a function that does not return has moved from its arguments.
[[noreturn]] void refuse_seed(const Plc& plc, const std::string& what, const Point3& seed,
                              const std::vector<long long>& facets) {
  Place place;
  place.file = plc.name;
  place.points = {as_array(seed)};
  place.facets = facets;
  throw InputError(what, place, "move the seed into the part of space that it is for, or remove it");
}

RegionId region_of_seed(const Plc& plc, const TriangleSet& triangles, const VerticalRays& rays, const RegionMap& map,
                        const Point3& seed, const std::string& name) {
  // Seeds beyond the box of the vertices may not fit the grid.
  const auto outside = [&] { refuse_seed(plc, name + " is outside of all that the facets enclose", seed, {}); };
  Point3 low = plc.world.front(), high = low;
  for (const Point3& p : plc.world) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const bool within =
      seed.x >= low.x && seed.x <= high.x && seed.y >= low.y && seed.y <= high.y && seed.z >= low.z && seed.z <= high.z;
  if (!within) outside();
  const RayStart start = RayStart::at(plc.grid.snap(seed));
  if (const auto t = rays.triangle_at(start)) refuse_seed(plc, name + " is on a facet", seed, {triangles.numbers[*t]});
  const RegionId region = region_at(map, rays, start);
  if (region == 0u) outside();
  return region;
}

[[noreturn]] void refuse_nothing_inside(const Plc& plc, const std::string& what, const std::string& remedy) {
  Place place;
  place.file = plc.name;
  throw InputError(what, place, remedy);
}

bool has_free_edge(const EdgeTable& edges) {
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (edges.around(e).size() == 1) return true;
  return false;
}

// Inside are the regions behind an odd number of connected surfaces, seen from infinity.
void mark_by_nesting(RegionMap& map) {
  for (std::uint32_t c = 1; c < map.regions.size(); ++c)
    for (RegionId outer(c); outer != 0u; outer = map.around[outer]) map.regions[c].inside = !map.regions[c].inside;
}

}  // namespace

void mark_inside(const InputPlc& input, const Plc& plc, const TriangleSet& triangles, const EdgeTable& edges,
                 const VerticalRays& rays, RegionMap& map) {
  const bool is_surface = input.inside == InputPlc::Inside::even_odd;
  const bool encloses = map.regions.size() > 1;
  if ((is_surface || !encloses) && has_free_edge(edges)) refuse_open_surface(plc, edges);
  if (!encloses) refuse_nothing_inside(plc, "the facets enclose nothing", "add the facets that close the surface");

  if (is_surface)
    mark_by_nesting(map);
  else
    for (std::uint32_t c = 1; c < map.regions.size(); ++c) map.regions[c].inside = true;
  for (std::size_t i = 0; i < input.holes.size(); ++i) {
    const std::string name = "hole seed " + std::to_string(i) + " (counted from 0)";
    map.regions[region_of_seed(plc, triangles, rays, map, input.holes[i], name)].inside = false;
  }
  for (std::size_t i = 0; i < input.regions.size(); ++i) {
    const std::string name = "region seed " + std::to_string(i) + " (counted from 0)";
    map.regions[region_of_seed(plc, triangles, rays, map, input.regions[i].seed, name)].attribute =
        input.regions[i].attribute;
  }
  if (std::none_of(map.regions.begin(), map.regions.end(), [](const Region& c) { return c.inside; }))
    refuse_nothing_inside(plc, "the hole seeds leave nothing to mesh", "remove the hole seed of the part to be meshed");
}

}  // namespace ccdt
