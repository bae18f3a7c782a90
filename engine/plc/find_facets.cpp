#include "engine/plc/find_facets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/base/index_lists.h"
#include "engine/base/parallel.h"
#include "engine/base/sort_in_runs.h"
#include "engine/geometry/integer_points.h"

namespace ccdt::plc {

namespace {

constexpr std::size_t grain = 4096;  // of loops on several threads

struct Plane {
  Point3 normal;  // of any length
  Point3 point;

  double squared_distance(const Point3& p) const {
    const double d = dot(normal, p - point);
    return d * d / squared_length(normal);
  }
};

// The plane of a growing patch: its area vector, which depends on its outline alone and is therefore insensitive to the
// rounding of single triangles, and the mean of its corners.
struct FittedPlane {
  Point3 area, sum_of_offsets, reference;
  double count = 0;

  void add(const Point3& normal, const std::array<Point3, 3>& corners) {
    if (count == 0) reference = corners[0];
    area = area + normal;
    for (const Point3& p : corners) sum_of_offsets = sum_of_offsets + (p - reference);
    count += 3;
  }
  Plane plane() const { return {area, reference + (1.0 / count) * sum_of_offsets}; }
};

class PatchFinder {
 public:
  PatchFinder(std::span<const Point3> vertices, TriangleSet& triangles, EdgeTable& edges,
              std::span<const std::uint32_t> segment_of, std::span<const double> tolerances)
      : vertices_(vertices),
        triangles_(triangles),
        edges_(edges),
        tolerances_(tolerances),
        normals_(triangles.size()),
        facet_of_(triangles.size(), none),
        turned_(triangles.size(), 0),
        round_of_(triangles.size(), 0),
        may_cross_(edges.size()),
        is_lonely_(triangles.size()) {
    parallel_for(triangles.size(), grain,
                 [&](std::size_t t) { normals_[t] = rounded_normal(corner_points(static_cast<std::uint32_t>(t))); });
    edges.turns.assign(edges.size(), Turn::unknown);
    parallel_for(edges.size(), grain, [&](std::size_t i) {
      const auto e = static_cast<std::uint32_t>(i);
      const auto around = edges.around(e);
      if (around.size() != 2) return;
      edges.turns[e] = clear_turn(e);
      may_cross_[e] = segment_of[e] == none && triangles.markers[around[0]] == triangles.markers[around[1]];
    });
    parallel_for(triangles.size(), grain,
                 [&](std::size_t t) { is_lonely_[t] = is_lonely(static_cast<std::uint32_t>(t)); });
  }

  FacetPatches find() {
    std::vector<SizedTriangle> order = parallel_collect<SizedTriangle>(
        triangles_.size(), grain, [&](std::size_t t, std::size_t end, std::vector<SizedTriangle>& found) {
          for (; t < end; ++t)
            if (!is_lonely_[t]) found.push_back(sized(static_cast<std::uint32_t>(t)));
        });
    sort_in_runs(order);

    std::vector<std::uint32_t> seeds;
    for (const auto& [area, seed] : order) {
      if (facet_of_[seed] != none) continue;
      find_patch(seed);
      for (const std::uint32_t t : patch_) {
        facet_of_[t] = static_cast<std::uint32_t>(seeds.size());
        if (!turned_[t]) continue;
        std::swap(triangles_.corners[t][1], triangles_.corners[t][2]);
        note_turned(t, edges_);
      }
      seeds.push_back(seed);
    }
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (facet_of_[t] != none) continue;
      facet_of_[t] = static_cast<std::uint32_t>(seeds.size());
      seeds.push_back(t);
    }
    return number_by_first_triangle(seeds);
  }

 private:
  std::array<Point3, 3> corner_points(std::uint32_t t) const { return points_of(vertices_, triangles_.corners[t]); }

  // Patches of larger triangles grow first.
  struct SizedTriangle {
    double area;
    std::uint32_t triangle;

    bool operator<(const SizedTriangle& o) const { return area != o.area ? area > o.area : triangle < o.triangle; }
  };
  SizedTriangle sized(std::uint32_t t) const { return {squared_length(normals_[t]), t}; }

  FittedPlane plane_of(std::uint32_t t) const {
    FittedPlane fitted;
    fitted.add(normals_[t], corner_points(t));
    return fitted;
  }

  // The turn between the two triangles at an edge, if it is so clear that neither can be in the plane of the other:
  // both heights, which are the same volume over different areas, are above the tolerance. Otherwise unknown.
  Turn clear_turn(std::uint32_t e) const {
    constexpr double rounding = 64;  // grid units; heights are rounded by far less, here and in `find_turn`
    const auto sides = edges_.sides_around(e);
    const std::uint32_t s = triangle_of(sides[0]), t = triangle_of(sides[1]);
    const auto [a, b] = edges_.ends[e];
    const VertexId apex = apex_over(triangles_.corners[t], a, b);
    const double volume = dot(normals_[s], vertices_[apex] - vertices_[a]);
    const double least = std::min(tolerances_[s], tolerances_[t]) + rounding;
    if (volume * volume <= least * least * std::max(squared_length(normals_[s]), squared_length(normals_[t])))
      return Turn::unknown;
    return (volume > 0) == is_above(sides[0]) ? Turn::below_180 : Turn::above_180;
  }

  // Most triangles of a curved surface are separate facets. They are found before patches grow. A triangle is lonely
  // unless its patch would take in the neighbor at some edge.
  bool is_lonely(std::uint32_t t) const {
    return std::ranges::none_of(edges_.edges_of[t], [&](std::uint32_t e) {
      return may_cross_[e] && edges_.turns[e] == Turn::unknown &&
             find_turn(across(e, t), e, t, false, plane_of(t).plane());
    });
  }

  // Stores the patch of the seed in `patch_`. It grows along a plane that is fitted on the way. If some vertex is too
  // far from the final plane, it grows again along that fixed plane.
  void find_patch(std::uint32_t seed) {
    FittedPlane fitted = plane_of(seed);
    grow(seed, fitted, true);
    if (patch_.size() <= 1) return;
    const Plane plane = centered(fitted.plane());
    if (all_within(plane)) return;
    if (!is_within(seed, plane)) fitted = plane_of(seed);
    grow(seed, fitted, false);
  }

  void grow(std::uint32_t seed, FittedPlane& fitted, bool refit) {
    ++round_;
    Plane plane = fitted.plane();
    patch_.assign(1, seed);
    round_of_[seed] = round_;
    turned_[seed] = dot(normals_[seed], plane.normal) < 0;
    for (std::size_t i = 0; i < patch_.size(); ++i) {
      const std::uint32_t t = patch_[i];
      for (const std::uint32_t e : edges_.edges_of[t]) {
        const std::uint32_t next = neighbor_across(e, t);
        if (next == none || (is_lonely_[next] && sized(next) < sized(seed)) || !accept(next, e, t, plane)) continue;
        patch_.push_back(next);
        round_of_[next] = round_;
        if (!refit) continue;
        fitted.add(turned_[next] ? -1.0 * normals_[next] : normals_[next], corner_points(next));
        plane = fitted.plane();
      }
    }
  }

  std::uint32_t neighbor_across(std::uint32_t e, std::uint32_t t) const {
    if (!may_cross_[e]) return none;
    const std::uint32_t next = across(e, t);
    return facet_of_[next] == none && round_of_[next] != round_ ? next : none;
  }

  // The other triangle at an edge that a patch may grow over.
  std::uint32_t across(std::uint32_t e, std::uint32_t t) const {
    const auto around = edges_.around(e);
    return around[0] == t ? around[1] : around[0];
  }

  // Do the two triangles at the edge run along it the same way?
  bool run_the_same_way(std::uint32_t e) const {
    const auto sides = edges_.sides_around(e);
    return is_above(sides[0]) == is_above(sides[1]);
  }

  // Is the neighbor in the plane and, when oriented like the triangle it was reached from, counterclockwise in the
  // projection?
  bool accept(std::uint32_t next, std::uint32_t e, std::uint32_t t, const Plane& plane) {
    const auto turn = find_turn(next, e, t, static_cast<bool>(turned_[t]), plane);
    if (turn) turned_[next] = *turn;
    return turn.has_value();
  }

  // Must the neighbor of a triangle be turned to belong to the patch, given whether the triangle is turned? None if it
  // does not belong there.
  std::optional<bool> find_turn(std::uint32_t next, std::uint32_t e, std::uint32_t t, bool is_turned,
                                const Plane& plane) const {
    const auto [a, b] = edges_.ends[e];
    const VertexId apex = apex_over(triangles_.corners[next], a, b);
    const double tolerance = std::min(tolerances_[t], tolerances_[next]);
    for (const VertexId v : {apex, a, b})
      if (plane.squared_distance(vertices_[v]) > tolerance * tolerance) return std::nullopt;
    const bool turn = run_the_same_way(e) != is_turned;
    const int axis = dominant_axis(plane.normal);
    const double along = as_array(normals_[next])[axis] * as_array(plane.normal)[axis];  // signs are exact
    if (turn ? along >= 0 : along <= 0) return std::nullopt;
    return turn;
  }

  bool is_within(std::uint32_t t, const Plane& plane) const {
    for (const Point3& p : corner_points(t))
      if (plane.squared_distance(p) > tolerances_[t] * tolerances_[t]) return false;
    return true;
  }

  bool all_within(const Plane& plane) const {
    return std::all_of(patch_.begin(), patch_.end(), [&](std::uint32_t t) { return is_within(t, plane); });
  }

  // The parallel plane in the middle of the patch's vertices.
  Plane centered(Plane plane) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::uint32_t t : patch_)
      for (const Point3& p : corner_points(t)) {
        const double d = dot(plane.normal, p - plane.point);
        low = std::min(low, d);
        high = std::max(high, d);
      }
    plane.point = plane.point + (0.5 * (low + high) / squared_length(plane.normal)) * plane.normal;
    return plane;
  }

  FacetPatches number_by_first_triangle(const std::vector<std::uint32_t>& seeds) const {
    FacetPatches patches;
    patches.facet_of.resize(triangles_.size());
    std::vector<std::uint32_t> number(seeds.size(), none), reference;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      std::uint32_t& n = number[facet_of_[t]];
      if (n == none) {
        n = static_cast<std::uint32_t>(reference.size());
        reference.push_back(seeds[facet_of_[t]]);
      }
      patches.facet_of[t] = n;
    }
    patches.members =
        group_indices(reference.size(), triangles_.size(), [&](std::size_t t) { return patches.facet_of[t]; });
    patches.exactly_flat.assign(reference.size(), 1);
    parallel_for(reference.size(), 16, [&](std::size_t facet) {
      if (patches.members.of(facet).size() == 1) return;
      const std::array<Point3, 3> corners = corner_points(reference[facet]);
      const WideVector normal = exact_normal(corners);
      const IntegerPoint base = to_integers(corners[0]);
      const auto is_in_plane = [&](const Point3& p) { return height_over(base, normal, to_integers(p)) == 0; };
      patches.exactly_flat[facet] = std::ranges::all_of(patches.members.of(facet), [&](std::uint32_t t) {
        return t == reference[facet] || std::ranges::all_of(corner_points(t), is_in_plane);
      });
    });
    patches.is_inner_edge.assign(edges_.size(), 0);
    parallel_for(edges_.size(), grain, [&](std::size_t i) {
      const auto e = static_cast<std::uint32_t>(i);
      if (!may_cross_[e]) return;
      const auto around = edges_.around(e);
      patches.is_inner_edge[e] = facet_of_[around[0]] == facet_of_[around[1]] && !run_the_same_way(e);
    });
    return patches;
  }

  std::span<const Point3> vertices_;
  TriangleSet& triangles_;
  EdgeTable& edges_;
  std::span<const double> tolerances_;  // of the triangles
  std::vector<Point3> normals_;         // of the triangles as oriented in the input
  std::vector<std::uint32_t> facet_of_;
  std::vector<char> turned_;
  std::vector<std::uint32_t> round_of_;  // the last round of growing that reached the triangle
  std::vector<char> may_cross_;          // edges that a patch may grow over
  std::vector<char> is_lonely_;          // no neighbor belongs to the patch of the triangle
  std::uint32_t round_ = 0;
  std::vector<std::uint32_t> patch_;
};

}  // namespace

FacetPatches find_facets(std::span<const Point3> vertices, TriangleSet& triangles, EdgeTable& edges,
                         std::span<const std::uint32_t> segment_of, std::span<const double> tolerances) {
  return PatchFinder(vertices, triangles, edges, segment_of, tolerances).find();
}

}  // namespace ccdt::plc
