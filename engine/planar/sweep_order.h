#pragma once

#include <algorithm>
#include <optional>

#include "engine/planar/types.h"

namespace ccdt::planar {

/// The vertices in the order in which a line sweeps over them that turns counterclockwise around a corner of their
/// convex hull, the *pole*. A projective map that sends the pole to infinity makes it the order from left to right, and
/// among vertices on one ray from bottom (far from the pole) to top. Such a map keeps the signs of `orient`, so
/// whatever needs vertices sorted by coordinates and separated by vertical lines can do with this order and without
/// coordinates.
struct SweepOrder {
  PlanarTriangulationResult::Status status = PlanarTriangulationResult::Status::ok;
  VertexId pole;
  std::vector<VertexId> swept;         ///< all but the pole
  std::vector<PlanarEdge> duplicates;  ///< vertices at the same place
};

/// Three vertices that are not collinear, or nothing if there are none. (If the first vertices are all at one place,
/// only so many are tried as the second: then `nothing` may be wrong.)
template <PlanarPredicates P>
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

/// Of the vertices on the line through from and to, the last one in the direction from `to` to `from`.
template <PlanarPredicates P>
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
template <PlanarPredicates P>
VertexId find_pole(std::span<const VertexId> vertices, const std::array<VertexId, 3>& triangle, const P& predicates) {
  const auto [a, b, c] = triangle;
  std::vector<VertexId> left, right;  // the line itself counts as right
  bool beyond = false;
  for (VertexId v : vertices) {
    const int side = predicates.orient(a, b, v);
    (side > 0 ? left : right).push_back(v);
    beyond |= side < 0;
  }
  if (left.empty() || !beyond) return last_on_line(vertices, a, b, c, predicates);
  VertexId left_end = left.front(), right_end = a;
  for (bool raised = true; raised;) {
    raised = false;
    for (VertexId v : right) {
      if (v == right_end || predicates.orient(left_end, right_end, v) <= 0) continue;
      right_end = v;
      raised = true;
    }
    for (VertexId v : left) {
      if (v == left_end || predicates.orient(left_end, right_end, v) <= 0) continue;
      left_end = v;
      raised = true;
    }
  }
  // All vertices are on the line of the bridge or to the right of it.
  VertexId below;
  for (VertexId v : triangle) {
    if (predicates.orient(left_end, right_end, v) != 0) below = v;
  }
  return last_on_line(vertices, left_end, right_end, below, predicates);
}

/// Less-than of the sweep order.
template <PlanarPredicates P>
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

template <PlanarPredicates P>
SweepOrder sweep_order(std::span<const VertexId> vertices, const P& predicates) {
  using Status = PlanarTriangulationResult::Status;
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
      order.duplicates.push_back({pole, v});
    } else {
      order.swept.push_back(v);
    }
  }
  const SweptBefore<P> before{predicates, pole, off_ray};
  std::sort(order.swept.begin(), order.swept.end(), before);
  for (std::size_t i = 1; i < order.swept.size(); ++i) {
    if (!before(order.swept[i - 1], order.swept[i])) order.duplicates.push_back({order.swept[i - 1], order.swept[i]});
  }
  if (!order.duplicates.empty()) order.status = Status::duplicates;
  return order;
}

}  // namespace ccdt::planar
