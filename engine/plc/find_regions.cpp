#include "engine/plc/find_regions.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/union_find.h"
#include "engine/geometry/integer_points.h"
#include "engine/plc/close_triangles.h"
#include "engine/plc/input_faults.h"

namespace ccdt::plc {

namespace {

using VeryWide = boost::multiprecision::int256_t;

constexpr std::size_t at_once = 4096;  // of loops on several threads

IntegerPoint six_times(const Point3& p) {
  const IntegerPoint q = to_integers(p);
  return {6 * q[0], 6 * q[1], 6 * q[2]};
}

IntegerPoint sixfold_middle(const Point3& a, const Point3& b) {
  const IntegerPoint p = to_integers(a), q = to_integers(b);
  return {3 * (p[0] + q[0]), 3 * (p[1] + q[1]), 3 * (p[2] + q[2])};
}

IntegerPoint sixfold_centroid(const std::array<Point3, 3>& t) {
  const IntegerPoint p = to_integers(t[0]), q = to_integers(t[1]), r = to_integers(t[2]);
  return {2 * (p[0] + q[0] + r[0]), 2 * (p[1] + q[1] + r[1]), 2 * (p[2] + q[2] + r[2])};
}

// On which side of the line pq, seen from above, is the point x after its infinitesimal move?
int side_of_moved(const IntegerPoint& p, const IntegerPoint& q, const IntegerPoint& x) {
  const std::int64_t ux = q[0] - p[0], uy = q[1] - p[1];
  const int sign = sign_of(Wide(ux) * (x[1] - p[1]) - Wide(uy) * (x[0] - p[0]));
  if (sign != 0) return sign;
  if (uy != 0) return uy > 0 ? -1 : 1;
  return (ux > 0) - (ux < 0);
}

// A triangle over the start of the ray, with its height there as a fraction.
struct Crossing {
  std::uint32_t triangle;
  WideVector normal;  // turned upward
  bool turned;
  VeryWide height;  // sixfold, times normal[2]
};

int compare_products(const VeryWide& a, const VeryWide& b, const VeryWide& c, const VeryWide& d) {
  const VeryWide left = a * b, right = c * d;
  return left < right ? -1 : left > right ? 1 : 0;
}

// Is a lower at the start of the ray or, if both are equal, after the move aside?
bool is_lower(const Crossing& a, const Crossing& b) {
  const VeryWide az = a.normal[2], bz = b.normal[2];
  int sign = compare_products(a.height, bz, b.height, az);
  for (int k = 0; k < 2 && sign == 0; ++k)  // the slopes in x and y are -normal[k] / normal[2]
    sign = -compare_products(a.normal[k], bz, b.normal[k], az);
  return sign < 0;
}

Box box_above(const IntegerPoint& sixfold, bool upward) {
  const double scale = DyadicGrid::quantum / 6,
               slack = DyadicGrid::quantum;  // more than the rounding of this box
  const Point3 p = {scale * static_cast<double>(sixfold[0]), scale * static_cast<double>(sixfold[1]),
                    scale * static_cast<double>(sixfold[2])};
  const Point3 margin = {slack, slack, slack};
  Box box = {p - margin, p + margin};
  if (upward) box.high.z = std::numeric_limits<double>::infinity();
  return box;
}

// A triangle that a ray passes, and the side that it meets first.
struct RayHit {
  std::uint32_t triangle;
  bool enters_above;  // the ray comes from the side that the triangle's normal points to
};

// Shoots rays straight up (+z) through a set of triangles that do not cross each other, exactly. A ray is moved aside
// by an infinitesimal step in x and an infinitely smaller one in y, so that it passes no edge, no vertex and no upright
// triangle. Its start is a mean of up to three vertices, given in sixths of a quantum.
class VerticalRays {
 public:
  // \param tree  over the boxes of the triangles; without it, all are looked at for each ray. All three must outlive
  //              this
  VerticalRays(std::span<const Point3> vertices, const TriangleSet& triangles, const std::optional<BoxTree>& tree)
      : vertices_(vertices), triangles_(triangles), tree_(tree) {}

  // All triangles above the point from the lowest to the highest, except `own`.
  std::vector<RayHit> shoot(const IntegerPoint& q, std::optional<std::uint32_t> own = std::nullopt) const {
    std::vector<Crossing> crossings;
    for_each_meeting(box_above(q, true), [&](std::uint32_t t) {
      if (own && *own == t) return;
      const std::array<Point3, 3> points = points_of(vertices_, triangles_.corners[t]);
      const IntegerPoint a = six_times(points[0]), b = six_times(points[1]), c = six_times(points[2]);
      const int side = side_of_moved(a, b, q);
      if (side_of_moved(b, c, q) != side || side_of_moved(c, a, q) != side) return;
      WideVector n = exact_normal(points);
      const bool turned = n[2] < 0;
      if (turned) n = {-n[0], -n[1], -n[2]};
      if (height_over(a, n, q) > 0) return;  // the caller excludes zero: then the start is on the triangle
      const Wide height = n[2] * a[2] - n[0] * (q[0] - a[0]) - n[1] * (q[1] - a[1]);
      crossings.push_back({t, n, turned, VeryWide(height)});
    });
    std::sort(crossings.begin(), crossings.end(), is_lower);
    std::vector<RayHit> hits;
    for (const Crossing& c : crossings) hits.push_back({c.triangle, c.turned});
    return hits;
  }

  // Is the start of a ray on this triangle above it, once moved aside (or, if the triangle is not upright, raised)?
  bool leaves_above(std::uint32_t triangle) const {
    const WideVector n = exact_normal(points_of(vertices_, triangles_.corners[triangle]));
    if (n[2] != 0) return n[2] > 0;
    return n[0] != 0 ? n[0] > 0 : n[1] > 0;
  }

  // A triangle that the point is on.
  std::optional<std::uint32_t> triangle_at(const IntegerPoint& q) const {
    std::optional<std::uint32_t> found;
    for_each_meeting(box_above(q, false), [&](std::uint32_t t) {
      const std::array<Point3, 3> points = points_of(vertices_, triangles_.corners[t]);
      const IntegerPoint a = six_times(points[0]), b = six_times(points[1]), c = six_times(points[2]);
      if (height_over(a, exact_normal(points), q) != 0) return;
      const int axis = dominant_axis(points);
      const int u = orient_along(axis, a, b, q), v = orient_along(axis, b, c, q), w = orient_along(axis, c, a, q);
      if ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)) found = found ? std::min(*found, t) : t;
    });
    return found;
  }

 private:
  template <class Visit>
  void for_each_meeting(const Box& box, const Visit& visit) const {
    if (tree_) return tree_->for_each_meeting(box, visit);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      if (bounding_box(points_of(vertices_, triangles_.corners[t])).meets(box)) visit(t);
  }

  std::span<const Point3> vertices_;
  const TriangleSet& triangles_;
  const std::optional<BoxTree>& tree_;
};

// Joins the sides that see each other through the sector between two triangles. Within a facet, a tiny fold between the
// two does not matter.
//
// \return sets of sides, and after them a set for infinity
UnionFind join_through_sectors(std::uint32_t triangles, const EdgeTable& edges) {
  UnionFind sides(2 * std::size_t{triangles} + 1);
  parallel_for(edges.size(), at_once, [&](std::size_t e) {
    const auto around = edges.sides_around(static_cast<std::uint32_t>(e));
    for (std::size_t k = 0; k < around.size(); ++k)
      sides.join(around[k], opposite_of(around[k + 1 < around.size() ? k + 1 : 0]));
  });
  return sides;
}

// The sets of triangles connected by edges. Triangles around an edge see each other through its sectors.
UnionFind components_of(std::uint32_t triangles, UnionFind& sides) {
  UnionFind components(triangles);
  parallel_for(triangles, at_once, [&](std::size_t i) {
    const auto t = static_cast<std::uint32_t>(i);
    for (const bool above : {true, false}) components.join(t, triangle_of(sides.find(side_of(t, above))));
  });
  return components;
}

// One ray per component suffices: the sides of one component that see the same connected part of space are joined
// already. So on the way up from a component to whatever encloses it, every crossed component joins its outermost side.
RegionMap divide_space(const TriangleSet& triangles, std::span<const Point3> vertices, UnionFind& sides,
                       UnionFind& components, const VerticalRays& rays) {
  const std::uint32_t infinity = 2 * triangles.size();
  std::vector<std::uint32_t> outer_side(triangles.size());  // of the first triangle of each component
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (components.find(t) != t) continue;
    std::uint32_t left = side_of(t, rays.leaves_above(t));
    outer_side[t] = left;
    for (const RayHit& hit : rays.shoot(sixfold_centroid(points_of(vertices, triangles.corners[t])), t)) {
      sides.join(left, side_of(hit.triangle, hit.enters_above));
      left = side_of(hit.triangle, !hit.enters_above);
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
    const RegionId around = map.of_side[outer_side[components.find(triangle_of(s))]];
    if (map.of_side[s] != around) map.around[map.of_side[s]] = around;
  }
  return map;
}

// The region of a point that is on no triangle.
RegionId region_at(const RegionMap& map, const VerticalRays& rays, const IntegerPoint& sixfold) {
  const std::vector<RayHit> hits = rays.shoot(sixfold);
  return hits.empty() ? RegionId(0u) : map.of(hits.front().triangle, hits.front().enters_above);
}

constexpr const char* seed_remedy = "move the seed into the part of space that it is for, or remove it";

// \return  0 outside everything that the facets enclose
RegionId region_of_seed(const Plc& plc, const TriangleSet& triangles, const VerticalRays& rays, const RegionMap& map,
                        const Point3& seed, const std::string& name) {
  // Seeds beyond the box of the vertices may not fit the grid.
  if (!contains(bounding_box(plc.world), box_of(seed))) return RegionId(0u);
  const IntegerPoint start = six_times(plc.grid.snap(seed));
  if (const auto t = rays.triangle_at(start))
    throw_input_error(plc, name + " is on a facet", seed_remedy, {seed}, {triangles.numbers[*t]});
  return region_at(map, rays, start);
}

bool has_free_edge(const EdgeTable& edges) {
  for (std::uint32_t e = 0; e < edges.size(); ++e)
    if (edges.around(e).size() == 1) return true;
  return false;
}

// The regions behind an odd number of connected surfaces, seen from infinity, are inside.
void mark_by_nesting(RegionMap& map) {
  for (std::uint32_t c = 1; c < map.regions.size(); ++c)
    for (RegionId outer(c); outer != 0u; outer = map.around[outer]) map.regions[c].inside = !map.regions[c].inside;
}

// Regions in the domain that have no seed get the least positive numbers that no seed has.
void number_regions(const InputPlc& input, const std::vector<bool>& has_seed, RegionMap& map) {
  std::set<int> taken;
  for (const InputPlc::RegionSeed& seed : input.regions) taken.insert(seed.attribute);
  int next = 1;
  for (std::uint32_t c = 1; c < map.regions.size(); ++c) {
    if (!map.regions[c].inside || has_seed[c]) continue;
    while (taken.contains(next)) ++next;
    map.regions[c].attribute = next++;
  }
}

// \throw InputError  see `find_regions`
void mark_inside(const InputPlc& input, const Plc& plc, const TriangleSet& triangles, const EdgeTable& edges,
                 const VerticalRays& rays, RegionMap& map) {
  const bool is_surface = input.inside == InputPlc::Inside::even_odd;
  const bool encloses = map.regions.size() > 1;
  if ((is_surface || !encloses) && has_free_edge(edges)) throw_open_surface(plc, edges);
  if (!encloses) throw_input_error(plc, "the facets enclose nothing", "add the facets that close the surface");

  if (is_surface)
    mark_by_nesting(map);
  else
    for (std::uint32_t c = 1; c < map.regions.size(); ++c) map.regions[c].inside = true;
  for (std::size_t i = 0; i < input.holes.size(); ++i) {
    const std::string name = "hole seed " + std::to_string(i) + " (counted from 0)";
    const RegionId region = region_of_seed(plc, triangles, rays, map, input.holes[i], name);
    if (region == 0u)
      map.idle_holes.push_back(input.holes[i]);
    else
      map.regions[region].inside = false;
  }
  std::vector<bool> has_seed(map.regions.size(), false);
  for (std::size_t i = 0; i < input.regions.size(); ++i) {
    const std::string name = "region seed " + std::to_string(i) + " (counted from 0)";
    const RegionId region = region_of_seed(plc, triangles, rays, map, input.regions[i].seed, name);
    if (region == 0u)
      throw_input_error(plc, name + " is outside everything that the facets enclose", seed_remedy,
                        {input.regions[i].seed});
    map.regions[region].attribute = input.regions[i].attribute;
    map.regions[region].largest_volume = input.regions[i].max_volume;
    has_seed[region] = true;
  }
  number_regions(input, has_seed, map);
  if (std::none_of(map.regions.begin(), map.regions.end(), [](const Region& c) { return c.inside; }))
    throw_input_error(plc, "the hole seeds leave nothing to mesh", "remove the hole seed of the part to be meshed");
}

}  // namespace

RegionMap find_regions(const InputPlc& input, const Plc& plc, const PlcParts& parts, std::optional<BoxTree>& tree) {
  UnionFind sides = join_through_sectors(parts.triangles.size(), parts.edges);
  UnionFind components = components_of(parts.triangles.size(), sides);
  constexpr std::size_t few_rays = 3;
  std::size_t searches = 2 * (input.holes.size() + input.regions.size()) + parts.match.loose.size();
  for (std::uint32_t t = 0; t < parts.triangles.size(); ++t) searches += components.find(t) == t;
  if (!tree && searches > few_rays) tree = tree_of(plc.vertices, parts.triangles);
  const VerticalRays rays(plc.vertices, parts.triangles, tree);
  RegionMap map = divide_space(parts.triangles, plc.vertices, sides, components, rays);
  mark_inside(input, plc, parts.triangles, parts.edges, rays, map);
  for (const std::uint32_t s : parts.match.loose) {
    const auto [a, b] = parts.segments.ends[s];
    map.of_loose.push_back(region_at(map, rays, sixfold_middle(plc.vertices[a], plc.vertices[b])));
  }
  return map;
}

}  // namespace ccdt::plc
