#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/merge_sort.h"
#include "engine/planar/topology.h"
#include "engine/planar/triangulation.h"

namespace ccdt::planar {
/// The vertices in the order in which a line sweeps over them, turning counterclockwise around a corner of their convex
/// hull, the *pole*. A projective map that sends the pole to infinity makes this the order from left to right and,
/// among vertices on one ray, from bottom (far from the pole) to top. Such a map keeps the signs of `orient`. So an
/// algorithm that needs vertices sorted by coordinates and separated by vertical lines can use this order, without
/// coordinates.
struct SweepOrder {
  TriangulationResult::Status status = TriangulationResult::Status::ok;
  VertexId pole;
  std::vector<VertexId> swept;  ///< all except the pole
};

/// Three vertices that are not collinear, or nothing if there are none. (If the first vertices are all at one place,
/// only a limited number are tried as the second, so the answer "nothing" may be wrong.)
template <Predicates P>
std::optional<std::array<VertexId, 3>> find_triangle(std::span<const VertexId> vertices, const P& predicates) {
  constexpr std::size_t most_tries = 16;
  for (std::size_t second = 1; second < std::min(vertices.size(), most_tries); ++second) {
    for (VertexId third : vertices) {
      if (predicates.orient(vertices[0], vertices[second], third) != 0) {
        return std::array{vertices[0], vertices[second], third};
      }
    }
  }
  return std::nullopt;
}

/// The last vertex on the line through `from` and `to`, in the direction from `to` to `from`.
template <Predicates P>
VertexId last_on_line(std::span<const VertexId> vertices, VertexId from, VertexId to, VertexId off_line,
                      const P& predicates) {
  const int side = predicates.orient(off_line, to, from);
  VertexId last = from;
  for (VertexId v : vertices) {
    if (predicates.orient(from, to, v) == 0 && predicates.orient(off_line, last, v) == side) last = v;
  }
  return last;
}

/// A corner of the convex hull. The vertices are cut by the line ab; the bridge over that line, the edge of the hull
/// that crosses it, is found by raising its two ends in turn.
template <Predicates P>
VertexId find_pole(std::span<const VertexId> vertices, const std::array<VertexId, 3>& triangle, const P& predicates) {
  const auto [a, b, c] = triangle;
  std::vector<VertexId> left, right;  // the line itself counts as right
  bool has_right = false;
  for (VertexId v : vertices) {
    const int side = predicates.orient(a, b, v);
    (side > 0 ? left : right).push_back(v);
    has_right |= side < 0;
  }
  if (left.empty() || !has_right) return last_on_line(vertices, a, b, c, predicates);
  VertexId left_end = left.front(), right_end = a;
  bool raised = true;
  const auto raise = [&](VertexId& end, const std::vector<VertexId>& side) {
    for (VertexId v : side) {
      if (v == end || predicates.orient(left_end, right_end, v) <= 0) continue;
      end = v;
      raised = true;
    }
  };
  while (raised) {
    raised = false;
    raise(right_end, right);
    raise(left_end, left);
  }
  // All vertices are on the line of the bridge or to the right of it.
  VertexId below;
  for (VertexId v : triangle) {
    if (predicates.orient(left_end, right_end, v) != 0) below = v;
  }
  return last_on_line(vertices, left_end, right_end, below, predicates);
}

/// Less-than of the sweep order.
template <Predicates P>
struct SweptBefore {
  const P& predicates;
  VertexId pole;
  std::array<VertexId, 2> off_ray;  ///< not on one line with the pole

  bool operator()(VertexId p, VertexId q) const {
    if (p == q) return false;
    const int turn = predicates.orient(pole, p, q);
    if (turn != 0) return turn > 0;
    int side = predicates.orient(pole, p, off_ray[0]);
    VertexId off = off_ray[0];
    if (side == 0) {
      off = off_ray[1];
      side = predicates.orient(pole, p, off);
    }
    return predicates.orient(q, p, off) * side > 0;  // the farther one first
  }
};

template <Predicates P>
SweepOrder sweep_order(std::span<const VertexId> vertices, const P& predicates) {
  using Status = TriangulationResult::Status;
  SweepOrder order;
  const auto triangle = find_triangle(vertices, predicates);
  if (!triangle) {
    order.status = Status::collinear;
    return order;
  }
  const VertexId pole = order.pole = find_pole(vertices, *triangle, predicates);
  const auto [a, b, c] = *triangle;
  const std::array<VertexId, 2> off_ray = predicates.orient(pole, a, b) != 0   ? std::array{a, b}
                                          : predicates.orient(pole, b, c) != 0 ? std::array{b, c}
                                                                               : std::array{c, a};
  bool pole_met = false;
  for (VertexId v : vertices) {
    if (v == pole && !pole_met) {
      pole_met = true;
    } else if (predicates.orient(pole, v, off_ray[0]) == 0 && predicates.orient(pole, v, off_ray[1]) == 0) {
      order.status = Status::duplicates;
    } else {
      order.swept.push_back(v);
    }
  }
  const SweptBefore<P> before{predicates, pole, off_ray};
  merge_sort(order.swept, before);
  for (std::size_t i = 1; i < order.swept.size(); ++i) {
    if (!before(order.swept[i - 1], order.swept[i])) order.status = Status::duplicates;
  }
  return order;
}

/// The subdivision of the plane that the divide and conquer builds: directed edges, the two directions of one edge side
/// by side in the arrays (Guibas & Stolfi 1985, without the dual).
struct EdgeRings {
  using Edge = std::uint32_t;

  std::vector<VertexId> origins;
  std::vector<Edge> next_around;      ///< the next edge counterclockwise around the origin
  std::vector<Edge> previous_around;  ///< the next edge clockwise
  std::vector<bool> removed;          ///< by edge / 2

  static Edge reverse(Edge e) { return e ^ 1u; }
  VertexId origin(Edge e) const { return origins[e]; }
  VertexId target(Edge e) const { return origins[reverse(e)]; }
  /// The next edge around the face on the left.
  Edge next_left(Edge e) const { return previous_around[reverse(e)]; }
  /// The previous edge around the face on the right.
  Edge previous_right(Edge e) const { return next_around[reverse(e)]; }

  Edge add(VertexId from, VertexId to) {
    const auto e = static_cast<Edge>(origins.size());
    for (Edge side : {e, reverse(e)}) {
      origins.push_back(side == e ? from : to);
      next_around.push_back(side);
      previous_around.push_back(side);
    }
    removed.push_back(false);
    return e;
  }

  /// Joins the rings of two edges into one, or cuts their common ring in two.
  void splice(Edge a, Edge b) {
    const Edge after_a = next_around[a], after_b = next_around[b];
    next_around[a] = after_b;
    previous_around[after_b] = a;
    next_around[b] = after_a;
    previous_around[after_a] = b;
  }

  /// Adds an edge from the target of a to the origin of b, with the same face on the left of all three.
  Edge connect(Edge a, Edge b) {
    const Edge e = add(target(a), origin(b));
    splice(e, next_left(a));
    splice(reverse(e), b);
    return e;
  }

  void remove(Edge e) {
    splice(e, previous_around[e]);
    splice(reverse(e), previous_around[reverse(e)]);
    removed[e / 2] = true;
  }
};

/// The Delaunay triangulation of vertices in the sweep order (see `SweepOrder`), by divide and conquer.
template <Predicates P>
class DivideAndConquer {
 public:
  DivideAndConquer(std::span<const VertexId> swept, const P& predicates) : swept_(swept), predicates_(predicates) {
    rings_.origins.reserve(6 * swept.size());
    rings_.next_around.reserve(6 * swept.size());
    rings_.previous_around.reserve(6 * swept.size());
  }

  /// The triangles of the swept vertices, and a triangle from the pole to each edge of their convex hull that it sees.
  std::vector<std::array<VertexId, 3>> triangles_with_pole(VertexId pole) {
    std::vector<std::array<VertexId, 3>> triangles;
    triangles.reserve(2 * swept_.size());
    if (swept_.size() < 2) return triangles;
    const auto hull = EdgeRings::reverse(build(0, swept_.size()).first);
    std::vector<bool> done(rings_.origins.size(), false);
    auto e = hull;  // the outer face is on its left
    do {
      done[e] = true;
      const VertexId from = rings_.origin(e), to = rings_.target(e);
      if (predicates_.orient(from, to, pole) > 0) triangles.push_back({from, to, pole});
      e = rings_.next_left(e);
    } while (e != hull);
    for (e = 0; e < done.size(); ++e) {
      if (done[e] || rings_.removed[e / 2]) continue;
      const auto second = rings_.next_left(e), third = rings_.next_left(second);
      done[e] = done[second] = done[third] = true;
      triangles.push_back({rings_.origin(e), rings_.origin(second), rings_.origin(third)});
    }
    return triangles;
  }

 private:
  using Edge = EdgeRings::Edge;
  /// The hull's counterclockwise edge out of the leftmost vertex, and its clockwise edge out of the rightmost one.
  using HullEnds = std::pair<Edge, Edge>;

  bool is_left_of(VertexId v, Edge e) const { return predicates_.orient(v, rings_.origin(e), rings_.target(e)) > 0; }
  bool is_right_of(VertexId v, Edge e) const { return predicates_.orient(v, rings_.target(e), rings_.origin(e)) > 0; }

  HullEnds build(std::size_t begin, std::size_t end) {
    if (end - begin == 2) return build_two(swept_[begin], swept_[begin + 1]);
    if (end - begin == 3) return build_three(swept_[begin], swept_[begin + 1], swept_[begin + 2]);
    const std::size_t middle = begin + (end - begin) / 2;
    const HullEnds left = build(begin, middle);
    return merge(left, build(middle, end));
  }

  HullEnds build_two(VertexId a, VertexId b) {
    const Edge e = rings_.add(a, b);
    return {e, EdgeRings::reverse(e)};
  }

  HullEnds build_three(VertexId a, VertexId b, VertexId c) {
    const Edge ab = rings_.add(a, b), bc = rings_.add(b, c);
    rings_.splice(EdgeRings::reverse(ab), bc);
    const int turn = predicates_.orient(a, b, c);
    if (turn == 0) return {ab, EdgeRings::reverse(bc)};
    const Edge ca = rings_.connect(bc, ab);
    if (turn > 0) return {ab, EdgeRings::reverse(bc)};
    return {EdgeRings::reverse(ca), ca};
  }

  HullEnds merge(HullEnds left, HullEnds right) {
    Edge left_inner = left.second, right_inner = right.first;
    for (;;) {  // down to the lower common tangent
      if (is_left_of(rings_.origin(right_inner), left_inner)) {
        left_inner = rings_.next_left(left_inner);
      } else if (is_right_of(rings_.origin(left_inner), right_inner)) {
        right_inner = rings_.previous_right(right_inner);
      } else {
        break;
      }
    }
    const Edge base = rings_.connect(EdgeRings::reverse(right_inner), left_inner);
    if (rings_.origin(left_inner) == rings_.origin(left.first)) left.first = EdgeRings::reverse(base);
    if (rings_.origin(right_inner) == rings_.origin(right.second)) right.second = base;
    zip(base);
    return {left.first, right.second};
  }

  /// Closes the gap between the two halves above the base, which runs from right to left.
  void zip(Edge base) {
    for (;;) {
      const Edge left = candidate(base, EdgeRings::reverse(base), rings_.next_around);
      const Edge right = candidate(base, base, rings_.previous_around);
      const bool left_valid = is_right_of(rings_.target(left), base);
      const bool right_valid = is_right_of(rings_.target(right), base);
      if (!left_valid && !right_valid) return;
      const bool take_right =
          !left_valid || (right_valid && predicates_.incircle(rings_.target(left), rings_.origin(left),
                                                              rings_.origin(right), rings_.target(right)) > 0);
      base = take_right ? rings_.connect(right, EdgeRings::reverse(base))
                        : rings_.connect(EdgeRings::reverse(base), EdgeRings::reverse(left));
    }
  }

  /// The edge from an end of the base up to the vertex, on that side, that makes a Delaunay triangle with the base.
  /// Edges in the way are removed.
  ///
  /// \param from    the base as an edge out of that end
  /// \param around  turns about that end, from the base upward
  Edge candidate(Edge base, Edge from, const std::vector<Edge>& around) {
    Edge candidate = around[from];
    if (!is_right_of(rings_.target(candidate), base)) return candidate;
    for (;;) {
      const Edge next = around[candidate];
      work_done.edges_tested += next != from;
      if (next == from || predicates_.incircle(rings_.target(base), rings_.origin(base), rings_.target(candidate),
                                               rings_.target(next)) <= 0) {
        return candidate;
      }
      rings_.remove(candidate);
      candidate = next;
    }
  }

  std::span<const VertexId> swept_;
  const P& predicates_;
  EdgeRings rings_;
};

template <Predicates P>
TriangulationResult delaunay(std::span<const VertexId> vertices, const P& predicates) {
  TriangulationResult result;
  const SweepOrder order = sweep_order(vertices, predicates);
  result.status = order.status;
  if (!result) return result;
  const auto triangles = DivideAndConquer<P>(order.swept, predicates).triangles_with_pole(order.pole);
  result.triangulation = from_triangles(triangles);
  legalize(result.triangulation, predicates);
  return result;
}

}  // namespace ccdt::planar
