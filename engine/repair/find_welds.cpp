#include "engine/repair/find_welds.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "engine/base/parallel.h"
#include "engine/base/simplex_map.h"
#include "engine/geometry/box_tree.h"
#include "engine/geometry/closest_point.h"
#include "engine/geometry/exact_points.h"
#include "engine/geometry/predicates.h"
#include "engine/plc/close_triangles.h"

namespace ccdt::repair {
namespace {

using plc::VertexTriple;

/// An edge, from its smaller end to its greater one.
struct EdgeEnds {
  VertexId a, b;
  std::uint64_t key() const { return edge_key(a, b); }
};

EdgeEnds edge_of(const VertexTriple& t, std::size_t k) {
  return {std::min(t[k], t[plc::next_corner(k)]), std::max(t[k], t[plc::next_corner(k)])};
}

/// The positions on two lines, p + s u and q + t v, where these are nearest to each other; none if they are parallel.
std::optional<std::array<double, 2>> nearest_on_lines(const Point3& p, const Point3& u, const Point3& q,
                                                      const Point3& v) {
  const auto product = [](const Point3& a, const Point3& b) {
    const IntegerPoint x = to_integers(a), y = to_integers(b);
    return Long(Wide(x[0]) * y[0] + Wide(x[1]) * y[1] + Wide(x[2]) * y[2]);
  };
  // Differences of these products are tiny for nearly parallel lines.
  const Long uu = product(u, u), uv = product(u, v), vv = product(v, v);
  const Long up = product(u, p - q), vp = product(v, p - q);
  const Long determinant = uu * vv - uv * uv;
  if (determinant == 0) return std::nullopt;
  const auto divisor = static_cast<double>(determinant);
  return std::array{static_cast<double>(Long(uv * vp - vv * up)) / divisor,
                    static_cast<double>(Long(uu * vp - uv * up)) / divisor};
}

/// Looks at pairs of triangles.
class WeldFinder {
 public:
  WeldFinder(std::span<const Point3> vertices, const plc::TriangleSet& triangles, const WeldReach& reach)
      : vertices_(vertices), triangles_(triangles), reach_(reach) {}

  void look_at(std::uint32_t s, std::uint32_t t, Welds& welds) const {
    Pair pair;
    look_from(s, t, pair);
    look_from(t, s, pair);
    if (!pair.is_inexact) return;
    std::ranges::copy(pair.welds.equal, std::back_inserter(welds.equal));
    std::ranges::copy(pair.welds.on_edges, std::back_inserter(welds.on_edges));
    std::ranges::copy(pair.welds.in_triangles, std::back_inserter(welds.in_triangles));
  }

 private:
  bool are_near(const Point3& p, const Point3& q) const { return squared_length(p - q) <= reach_.edges * reach_.edges; }
  bool should_be_one(const Point3& p, const Point3& q) const {
    return squared_length(p - q) <= reach_.vertices * reach_.vertices;
  }
  bool is_near_segment(const Point3& p, const Point3& a, const Point3& b) const {
    return are_near(p, closest_on_segment(p, a, b));
  }
  bool is_near_triangle(const Point3& p, const std::array<Point3, 3>& t) const {
    const auto [u, v, w] = closest_on_triangle(p, t);
    return are_near(p, u * t[0] + v * t[1] + w * t[2]);
  }

  struct Pair {
    Welds welds;
    bool is_inexact = false;  ///< is anything near, but not at the same place?
  };

  /// Where something is at a triangle: a bit for each edge that it is on; no bits if it is inside.
  using Mask = unsigned;

  /// A point of an edge at a triangle.
  struct Near {
    double position;  ///< from 0 to 1
    Point3 point;
    Mask mask;
  };

  /// Looks for vertices and edges of one triangle at the other.
  void look_from(std::uint32_t one, std::uint32_t other, Pair& pair) const {
    const VertexTriple &c = triangles_.corners[one], &t = triangles_.corners[other];
    const Box box = expanded(bounding_box(plc::points_of(vertices_, t)), reach_.vertices);
    std::array<std::optional<Mask>, 3> at;
    for (std::size_t k = 0; k < 3; ++k)
      if (box.meets(box_of(vertices_[c[k]]))) at[k] = look_at_vertex(c[k], other, pair);
    for (std::size_t k = 0; k < 3; ++k) {
      const EdgeEnds e = edge_of(c, k);
      if (plc::has_corner(t, e.a) && plc::has_corner(t, e.b)) continue;
      if (!box.meets(hull(box_of(vertices_[e.a]), box_of(vertices_[e.b])))) continue;
      const bool is_turned = e.a != c[k];
      look_at_edge(e, at[is_turned ? plc::next_corner(k) : k], at[is_turned ? k : plc::next_corner(k)], other, pair);
    }
  }

  /// Where is a vertex at a triangle? None if it is not there.
  std::optional<Mask> look_at_vertex(VertexId v, std::uint32_t triangle, Pair& pair) const {
    const VertexTriple& t = triangles_.corners[triangle];
    const Point3& p = vertices_[v];
    for (std::size_t k = 0; k < 3; ++k)
      if (t[k] == v) return Mask{1u << k | 1u << (k + 2) % 3};
    for (std::size_t k = 0; k < 3; ++k)
      if (should_be_one(p, vertices_[t[k]])) {
        pair.welds.equal.push_back({v, t[k]});
        pair.is_inexact = true;
        return Mask{1u << k | 1u << (k + 2) % 3};
      }
    for (std::size_t k = 0; k < 3; ++k) {
      const EdgeEnds f = edge_of(t, k);
      if (!is_near_segment(p, vertices_[f.a], vertices_[f.b])) continue;
      pair.welds.on_edges.emplace_back(f.key(), p);
      pair.is_inexact = true;
      return Mask{1u << k};
    }
    if (!is_near_triangle(p, plc::points_of(vertices_, t))) return std::nullopt;
    pair.welds.in_triangles.push_back({triangle, v, v, p, p});
    pair.is_inexact = true;
    return Mask{0};
  }

  void look_at_edge(const EdgeEnds& e, std::optional<Mask> at_a, std::optional<Mask> at_b, std::uint32_t triangle,
                    Pair& pair) const {
    const Point3 &a = vertices_[e.a], &b = vertices_[e.b];
    const Box box = expanded(hull(box_of(a), box_of(b)), reach_.edges);
    std::vector<Near> near;
    if (at_a) near.push_back({0, a, *at_a});
    if (at_b) near.push_back({1, b, *at_b});
    const VertexTriple& t = triangles_.corners[triangle];
    for (std::size_t k = 0; k < 3; ++k) {
      if (const auto at = crossing(e, edge_of(t, k), pair)) near.push_back({at->first, at->second, 1u << k});
      const Point3& corner = vertices_[t[k]];
      if (t[k] == e.a || t[k] == e.b || should_be_one(corner, a) || should_be_one(corner, b)) continue;
      if (!box.meets(box_of(corner))) continue;
      if (is_near_segment(corner, a, b))
        near.push_back({dot(corner - a, b - a) / squared_length(b - a), corner, 1u << k | 1u << (k + 2) % 3});
    }
    if (near.size() < 2) return;
    const auto [first, last] = std::ranges::minmax_element(near, {}, &Near::position);
    if (first->point != last->point && (first->mask & last->mask) == 0)
      pair.welds.in_triangles.push_back({triangle, e.a, e.b, first->point, last->point});
  }

  /// Where two edges pass each other, away from their ends: the position on the first one, and the common point.
  std::optional<std::pair<double, Point3>> crossing(const EdgeEnds& e, const EdgeEnds& f, Pair& pair) const {
    if (e.a == f.a || e.a == f.b || e.b == f.a || e.b == f.b) return std::nullopt;
    const Point3 &a = vertices_[e.a], &b = vertices_[e.b], &c = vertices_[f.a], &d = vertices_[f.b];
    if (!expanded(hull(box_of(a), box_of(b)), reach_.edges).meets(hull(box_of(c), box_of(d)))) return std::nullopt;
    if (is_near_segment(a, c, d) || is_near_segment(b, c, d) || is_near_segment(c, a, b) || is_near_segment(d, a, b))
      return std::nullopt;
    const auto positions = nearest_on_lines(a, b - a, c, d - c);
    if (!positions) return std::nullopt;
    const auto [s, t] = *positions;
    if (s <= 0 || s >= 1 || t <= 0 || t >= 1) return std::nullopt;
    const Point3 p = a + s * (b - a), q = c + t * (d - c);
    if (!are_near(p, q)) return std::nullopt;
    const Point3 middle = e.key() < f.key() ? p + 0.5 * (q - p) : q + 0.5 * (p - q);
    const auto round = [](double x) { return DyadicGrid::quantum * std::nearbyint(x / DyadicGrid::quantum); };
    const Point3 point = {round(middle.x), round(middle.y), round(middle.z)};
    pair.welds.on_edges.emplace_back(e.key(), point);
    pair.welds.on_edges.emplace_back(f.key(), point);
    pair.is_inexact = pair.is_inexact || orient3d(a, b, c, d) != 0;
    return std::pair{s, point};
  }

  std::span<const Point3> vertices_;
  const plc::TriangleSet& triangles_;
  WeldReach reach_;
};

}  // namespace

Welds find_welds(std::span<const Point3> vertices, const plc::TriangleSet& triangles,
                 const std::vector<std::uint8_t>& is_near, const WeldReach& reach) {
  const std::vector<std::uint32_t> sought = parallel_select(triangles.size(), 4096, [&](std::size_t t) {
    return std::ranges::any_of(triangles.corners[t], [&](VertexId v) { return is_near[v] != 0; });
  });
  const auto box = [&](std::uint32_t t) {
    return expanded(bounding_box(plc::points_of(vertices, triangles.corners[t])), 0.5 * reach.vertices);
  };
  const BoxTree tree(sought, box);
  const WeldFinder finder(vertices, triangles, reach);
  const std::vector<Welds> parts = parallel_chunks(sought.size(), 256, [&](std::size_t begin, std::size_t end) {
    Welds welds;
    for (std::size_t i = begin; i < end; ++i)
      tree.for_each_meeting(box(sought[i]), [&](std::uint32_t j) {
        if (i < j) finder.look_at(sought[i], sought[j], welds);
      });
    return welds;
  });
  Welds all;
  for (const Welds& part : parts) {
    std::ranges::copy(part.equal, std::back_inserter(all.equal));
    std::ranges::copy(part.on_edges, std::back_inserter(all.on_edges));
    std::ranges::copy(part.in_triangles, std::back_inserter(all.in_triangles));
  }
  return all;
}

}  // namespace ccdt::repair
