#include "engine/plc/edge_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/merge_sort.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/geometry/integer_points.h"
#include "engine/geometry/predicates.h"

namespace ccdt::plc {
namespace {

constexpr std::size_t chunk_length = 4096;  // of loops on several threads

// For c and d coplanar with the edge ab: are they on the same side of it?
bool on_same_side(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const int axis = dominant_axis({a, b, c});
  return orient_along(axis, a, b, c) == orient_along(axis, a, b, d);
}

// Two facets at an edge are close only because of their angle, and angles of narrow triangles are not reliable.
constexpr double reliable_heights = 100;  // tolerances

bool nearly_cover(const Point3& a, const Point3& b, const Point3& c, const Point3& d, double tolerance) {
  const Point3 m = cross(b - a, c - a), n = cross(b - a, d - a);
  const double mm = squared_length(m), nn = squared_length(n);
  const double least = reliable_heights * tolerance;
  const double least_area = least * least * squared_length(b - a);
  if (dot(m, n) <= 0 || mm < least_area || nn < least_area) return false;
  return std::fabs(dot(m, d - a)) <= tolerance * std::sqrt(mm) && std::fabs(dot(n, c - a)) <= tolerance * std::sqrt(nn);
}

// A point in both triangles abc and abd, which are on the same side of ab: starts at the middle of the edge and moves
// inward until it is in both.
Point3 common_point(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const Point3 middle = 0.5 * (a + b), inward = 0.5 * (c + d) - middle;
  const auto holds = [&](const Point3& apex, const Point3& p) {
    const Point3 normal = cross(b - a, apex - a);
    return dot(normal, cross(apex - b, p - b)) >= 0 && dot(normal, cross(a - apex, p - apex)) >= 0;
  };
  double step = 0.5;
  while (step > 1e-6 && !(holds(c, middle + step * inward) && holds(d, middle + step * inward))) step *= 0.5;
  return middle + step * inward;
}

/// The edges of triangles by their smaller ends: those of vertex v are entries[first[v]] ... entries[first[v+1]-1],
/// sorted.
struct TriangleEdges {
  std::vector<std::uint32_t> first;
  /// The greater end, then 3 * triangle + corner, then whether the triangle runs along the edge from the greater end.
  RawVector<std::uint64_t> entries;

  /// Does the edge in this place differ from the one before?
  bool is_new(std::size_t v, std::uint32_t i) const {
    return i == first[v] || entries[i] >> 32 != entries[i - 1] >> 32;
  }
};

TriangleEdges gather_edges(std::span<const VertexTriple> triangles) {
  std::uint32_t vertices = 0;
  for (const VertexTriple& t : triangles) vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
  TriangleEdges edges;
  auto& [first, entries] = edges;
  first.assign(vertices + 2, 0);
  entries.resize(3 * triangles.size());
  const auto for_each = [&](const auto& visit) {
    parallel_for(triangles.size(), chunk_length, [&](std::size_t i) {
      const VertexTriple& t = triangles[i];
      for (std::uint32_t k = 0; k < 3; ++k) visit(3 * i + k, t[k], t[k == 2 ? 0 : k + 1]);
    });
  };
  const AddOne add_one;
  for_each([&](std::size_t, VertexId a, VertexId b) { add_one(first[2 + std::min(a, b)]); });
  // Each list's beginning, stored one place too far. Filling moves it to the list's end, the next one's beginning.
  std::partial_sum(first.begin(), first.end(), first.begin());
  for_each([&](std::size_t slot, VertexId a, VertexId b) {
    entries[add_one(first[1 + std::min(a, b)])] = std::uint64_t{std::max(a, b)} << 32 | 2 * slot | (a < b ? 0 : 1);
  });
  parallel_for(vertices, chunk_length,
               [&](std::size_t v) { std::sort(entries.begin() + first[v], entries.begin() + first[v + 1]); });
  return edges;
}

}  // namespace

EdgeTable make_edge_table(std::span<const VertexTriple> triangles) {
  const TriangleEdges edges = gather_edges(triangles);
  const auto& [first, entries] = edges;
  EdgeTable table;
  table.sides.resize(entries.size());
  table.edges_of.resize(triangles.size());
  parallel_pack(
      first.size() - 2, chunk_length,
      [&](std::size_t v, std::size_t end) {
        std::size_t count = 0;
        for (; v < end; ++v)
          for (std::uint32_t i = first[v]; i < first[v + 1]; ++i) count += edges.is_new(v, i);
        return count;
      },
      [&](std::size_t count) {
        table.ends.resize(count);
        table.first.resize(count + 1, static_cast<std::uint32_t>(entries.size()));
      },
      [&](std::size_t v, std::size_t end, std::size_t next) {
        for (; v < end; ++v)
          for (std::uint32_t i = first[v]; i < first[v + 1]; ++i) {
            if (edges.is_new(v, i)) {
              table.ends[next] = {VertexId(v), VertexId(entries[i] >> 32)};
              table.first[next++] = i;
            }
            const auto slot = static_cast<std::uint32_t>(entries[i]) / 2;
            table.sides[i] = side_of(slot / 3, entries[i] % 2 == 0);
            table.edges_of[slot / 3][slot % 3] = static_cast<std::uint32_t>(next - 1);
          }
      });
  return table;
}

std::uint32_t EdgeTable::find(VertexId a, VertexId b) const {
  const std::array<VertexId, 2> sought = {std::min(a, b), std::max(a, b)};
  const auto at = std::lower_bound(ends.begin(), ends.end(), sought);
  return at != ends.end() && *at == sought ? static_cast<std::uint32_t>(at - ends.begin()) : none;
}

SegmentMatch match_segments(const SegmentSet& segments, const EdgeTable& edges) {
  SegmentMatch match;
  match.segment_of.assign(edges.size(), none);
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    const std::uint32_t e = edges.find(segments.ends[s][0], segments.ends[s][1]);
    if (e == none)
      match.loose.push_back(s);
    else
      match.segment_of[e] = s;
  }
  return match;
}

void note_turned(std::uint32_t triangle, EdgeTable& edges) {
  for (const std::uint32_t e : edges.edges_of[triangle])
    for (std::uint32_t& side : edges.sides_around(e))
      if (triangle_of(side) == triangle) side = opposite_of(side);
}

Turn turn_about(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const int sign = orient3d(a, b, c, d);
  if (sign > 0) return Turn::below_180;
  if (sign < 0) return Turn::above_180;
  return on_same_side(a, b, c, d) ? Turn::zero : Turn::exactly_180;
}

std::vector<Overlap> sort_around_edges(std::span<const Point3> vertices, const TriangleSet& triangles,
                                       const std::vector<char>& is_inner_edge, double tolerance, EdgeTable& edges,
                                       std::size_t limit) {
  const auto sort_around = [&](std::uint32_t e, std::vector<Overlap>& covering) {
    const std::span<std::uint32_t> around = edges.sides_around(e);
    if (is_inner_edge[e] || around.size() < 2 || edges.turns[e] != Turn::unknown) return;
    const Point3 &a = vertices[edges.ends[e][0]], &b = vertices[edges.ends[e][1]];
    const auto apex = [&](std::uint32_t side) -> const Point3& {
      return vertices[apex_over(triangles.corners[triangle_of(side)], edges.ends[e][0], edges.ends[e][1])];
    };
    if (around.size() > 2) {
      const Point3& zero = apex(around[0]);
      std::vector<std::uint32_t> others(around.begin() + 1, around.end());
      merge_sort(others, [&](std::uint32_t s, std::uint32_t t) {
        const Turn to_s = turn_about(a, b, zero, apex(s)), to_t = turn_about(a, b, zero, apex(t));
        if (to_s != to_t) return to_s < to_t;
        if (to_s == Turn::below_180 || to_s == Turn::above_180) {
          const int sign = orient3d(a, b, apex(s), apex(t));
          if (sign != 0) return sign > 0;
        }
        return s < t;
      });
      std::ranges::copy(others, around.begin() + 1);
    }
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (i == 1 && around.size() == 2) break;  // the same pair again
      const std::uint32_t s = around[i], t = around[(i + 1) % around.size()];
      const Point3 &c = apex(s), &d = apex(t);
      const Turn turn = turn_about(a, b, c, d);
      if (around.size() == 2) edges.turns[e] = turn;
      if (turn != Turn::zero && !nearly_cover(a, b, c, d, tolerance)) continue;
      covering.push_back({Overlap::Between::covering_facets, triangle_of(s), triangle_of(t), common_point(a, b, c, d)});
      if (covering.size() == limit) return;
    }
  };
  std::vector<Overlap> covering = parallel_collect<Overlap>(
      edges.size(), chunk_length, [&](std::size_t begin, std::size_t end, std::vector<Overlap>& found) {
        for (std::size_t e = begin; e < end && found.size() < limit; ++e)
          sort_around(static_cast<std::uint32_t>(e), found);
      });
  if (covering.size() > limit) covering.resize(limit);
  return covering;
}

}  // namespace ccdt::plc
