#pragma once

#include <utility>

#include "engine/planar/sweep_order.h"
#include "engine/planar/types.h"

namespace ccdt::planar {

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
  Edge next_left(Edge e) const { return previous_around[reverse(e)]; }  ///< the next edge around the face on the left
  Edge previous_right(Edge e) const {
    return next_around[reverse(e)];
  }  ///< the previous edge around the face on the right

  Edge add(VertexId from, VertexId to);
  /// Joins the rings of two edges into one, or cuts their common ring in two.
  void splice(Edge a, Edge b);
  /// Adds an edge from the target of a to the origin of b, with the same face on the left of all three.
  Edge connect(Edge a, Edge b);
  void remove(Edge e);
};

/// The Delaunay triangulation of vertices in the sweep order (see `SweepOrder`), by divide and conquer.
template <PlanarPredicates P>
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
      const Edge left = left_candidate(base), right = right_candidate(base);
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

  /// The edge up from the base's left end to the vertex that makes a Delaunay triangle with the base among those on the
  /// left; edges in the way are removed.
  Edge left_candidate(Edge base) {
    Edge candidate = rings_.next_around[EdgeRings::reverse(base)];
    if (!is_right_of(rings_.target(candidate), base)) return candidate;
    for (;;) {
      const Edge next = rings_.next_around[candidate];
      if (next == EdgeRings::reverse(base) ||
          predicates_.incircle(rings_.target(base), rings_.origin(base), rings_.target(candidate),
                               rings_.target(next)) <= 0) {
        return candidate;
      }
      rings_.remove(candidate);
      candidate = next;
    }
  }

  Edge right_candidate(Edge base) {
    Edge candidate = rings_.previous_around[base];
    if (!is_right_of(rings_.target(candidate), base)) return candidate;
    for (;;) {
      const Edge next = rings_.previous_around[candidate];
      if (next == base || predicates_.incircle(rings_.target(base), rings_.origin(base), rings_.target(candidate),
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

}  // namespace ccdt::planar
