#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include "engine/planar/triangulation.h"

namespace ccdt::planar_test {

struct IntegerPoint {
  std::int64_t x, y;
  auto operator<=>(const IntegerPoint&) const = default;
};

/// Points with integer coordinates (of at most 2^20, say) as a model of `planar::Predicates`, written as plainly as
/// possible. It counts its evaluations.
struct IntegerPlane {
  std::vector<IntegerPoint> points;
  mutable std::size_t calls = 0;

  std::int64_t area(VertexId a, VertexId b, VertexId c) const {
    const IntegerPoint &p = points[a], &q = points[b], &r = points[c];
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  }

  int orient(VertexId a, VertexId b, VertexId c) const {
    ++calls;
    const std::int64_t twice = area(a, b, c);
    return (twice > 0) - (twice < 0);
  }

  int incircle(VertexId a, VertexId b, VertexId c, VertexId d) const {
    ++calls;
    const std::array<VertexId, 4> ids{a, b, c, d};
    std::array<std::int64_t, 4> heights;
    for (std::size_t i = 0; i < 4; ++i)
      heights[i] = points[ids[i]].x * points[ids[i]].x + points[ids[i]].y * points[ids[i]].y;
    if (const int sign = lifted_sign(ids, heights)) return sign;
    // A tie: the lifted point of the smallest id is raised by the most.
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return ids[i] < ids[j]; });
    for (std::size_t raised : order) {
      std::array<std::int64_t, 4> change{};
      change[raised] = 1;
      if (const int sign = lifted_sign(ids, change)) return sign;
    }
    return 0;
  }

 private:
  /// The sign of the determinant of the rows (x, y, height, 1): positive if d is below the plane of the lifted a, b, c.
  /// Expanded along the heights.
  int lifted_sign(const std::array<VertexId, 4>& ids, const std::array<std::int64_t, 4>& heights) const {
    __extension__ __int128 determinant = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<VertexId, 3> rest;
      std::size_t count = 0;
      for (std::size_t j = 0; j < 4; ++j) {
        if (j != i) rest[count++] = ids[j];
      }
      determinant +=
          static_cast<decltype(determinant)>(i % 2 == 0 ? heights[i] : -heights[i]) * area(rest[0], rest[1], rest[2]);
    }
    return (determinant > 0) - (determinant < 0);
  }
};

using Triangles = std::vector<std::array<VertexId, 3>>;

inline std::vector<VertexId> all_vertices(const IntegerPlane& plane) {
  std::vector<VertexId> vertices;
  for (std::size_t i = 0; i < plane.points.size(); ++i) vertices.emplace_back(i);
  return vertices;
}

inline planar::Edge edge(std::uint32_t a, std::uint32_t b) {
  return {VertexId(a), VertexId(b)};
}
inline std::array<VertexId, 3> triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return {VertexId(a), VertexId(b), VertexId(c)};
}

/// The triangles in a form that can be compared: each from its smallest vertex on, and sorted.
inline Triangles canonical(const planar::Triangulation& t) {
  Triangles triangles = t.triangles;
  for (auto& corners : triangles)
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

inline std::int64_t twice_area(const planar::Triangulation& t, const IntegerPlane& plane) {
  std::int64_t sum = 0;
  for (const auto& [a, b, c] : t.triangles) sum += plane.area(a, b, c);
  return sum;
}

inline bool has_constrained(const planar::Triangulation& t, VertexId a, VertexId b) {
  const auto side = planar::find_edge(t, a, b);
  return side && t.constrained[side->triangle][side->corner];
}

/// The same edge seen from its other triangle; nothing at the border.
inline std::optional<planar::Side> side_across(const planar::Triangulation& t, planar::Side side) {
  if (planar::neighbor(t, side) == none) return std::nullopt;
  return planar::other_side(t, side);
}

/// All constrained edges, each once, the smaller id first, sorted.
inline std::vector<planar::Edge> constrained_edges(const planar::Triangulation& t) {
  std::set<planar::Edge> edges;
  for (std::uint32_t packed = 0; packed < 3 * t.triangles.size(); ++packed) {
    const planar::Side s = planar::unpack(packed);
    const VertexId a = planar::edge_start(t, s), b = planar::edge_end(t, s);
    if (planar::is_constrained(t, s)) edges.insert({std::min(a, b), std::max(a, b)});
  }
  return {edges.begin(), edges.end()};
}

/// The invariants of a triangulation: mutual adjacency, correct maps, counterclockwise triangles.
inline void expect_sound(const planar::Triangulation& t, const IntegerPlane& plane) {
  ASSERT_EQ(t.neighbors.size(), t.triangles.size());
  ASSERT_EQ(t.constrained.size(), t.triangles.size());
  const planar::Triangulation rebuilt = planar::from_triangles(t.triangles);
  EXPECT_EQ(t.neighbors, rebuilt.neighbors);
  for (std::uint32_t i = 0; i < t.triangles.size(); ++i) {
    const auto& [a, b, c] = t.triangles[i];
    EXPECT_EQ(plane.orient(a, b, c), 1);
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const VertexId from = t.triangles[i][(corner + 1) % 3], to = t.triangles[i][(corner + 2) % 3];
      const auto& around = t.triangles[t.triangle_of_vertex.get(from, none)];
      EXPECT_NE(std::find(around.begin(), around.end(), from), around.end());
      if (const auto other = side_across(t, {i, corner})) {
        EXPECT_EQ(t.constrained[other->triangle][other->corner], t.constrained[i][corner]);
      }
      const auto found = planar::find_edge(t, to, from);
      ASSERT_TRUE(found);
      const auto found_other = side_across(t, *found);
      EXPECT_TRUE((found->triangle == i && found->corner == corner) ||
                  (found_other && found_other->triangle == i && found_other->corner == corner));
    }
  }
}

/// Constrained Delaunay, by the definition of its edges.
inline void expect_locally_delaunay(const planar::Triangulation& t, const IntegerPlane& plane) {
  for (std::uint32_t i = 0; i < t.triangles.size(); ++i) {
    const auto& [a, b, c] = t.triangles[i];
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const auto other = side_across(t, {i, corner});
      if (!other || t.constrained[i][corner]) continue;
      EXPECT_LT(plane.incircle(a, b, c, t.triangles[other->triangle][other->corner]), 0);
    }
  }
}

/// Delaunay by the definition of its triangles: no vertex at all in any circumcircle.
inline void expect_empty_circles(const planar::Triangulation& t, const IntegerPlane& plane) {
  for (const auto& [a, b, c] : t.triangles) {
    for (VertexId d : all_vertices(plane)) {
      if (d == a || d == b || d == c) continue;
      EXPECT_LT(plane.incircle(a, b, c, d), 0);
    }
  }
}

// ---- Point sets -----------------------------------------------------------------------------------------------------

inline IntegerPlane random_points(std::size_t count, std::int64_t extent, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::set<IntegerPoint> different;
  IntegerPlane plane;
  while (plane.points.size() < count) {
    const IntegerPoint p{static_cast<std::int64_t>(random() % static_cast<std::uint32_t>(extent)),
                         static_cast<std::int64_t>(random() % static_cast<std::uint32_t>(extent))};
    if (different.insert(p).second) plane.points.push_back(p);
  }
  return plane;
}

inline IntegerPlane square_grid(std::int64_t side) {
  IntegerPlane plane;
  for (std::int64_t y = 0; y < side; ++y) {
    for (std::int64_t x = 0; x < side; ++x) plane.points.push_back({x, y});
  }
  return plane;
}

/// All integer points on a circle around the origin.
inline IntegerPlane circle_points(std::int64_t radius) {
  IntegerPlane plane;
  for (std::int64_t x = -radius; x <= radius; ++x) {
    const std::int64_t square = radius * radius - x * x;
    const std::int64_t y = std::llround(std::sqrt(static_cast<double>(square)));
    if (y * y != square) continue;
    plane.points.push_back({x, y});
    if (y != 0) plane.points.push_back({x, -y});
  }
  return plane;
}

}  // namespace ccdt::planar_test
