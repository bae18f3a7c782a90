#pragma once

#include "engine/planar/topology.h"
#include "engine/planar/types.h"

/// The steps of the planar algorithms that ask the predicates.
namespace ccdt::planar {

/// Flips from the given sides on until all of them, and all that the flips change, are locally Delaunay. A side in the
/// stack stands for whatever edge is there when its turn comes; a flip enters anew all edges that it moves.
template <PlanarPredicates P>
std::size_t legalize_from(PlanarTriangulation& t, std::vector<std::uint32_t>& stack, const P& predicates) {
  std::size_t flips = 0;
  while (!stack.empty()) {
    const PlanarSide s = unpack(stack.back());
    stack.pop_back();
    if (is_constrained(t, s) || neighbor(t, s) == none) continue;
    const VertexId a = edge_start(t, s), b = edge_end(t, s), c = apex(t, s), d = apex(t, other_side(t, s));
    if (predicates.incircle(a, b, c, d) <= 0) continue;
    // Exact predicates of one plane imply this; it keeps the triangles valid where the caller's plane is only nearly
    // one.
    if (predicates.orient(c, a, d) <= 0 || predicates.orient(d, b, c) <= 0) continue;
    for (PlanarSide outer : flip(t, s)) stack.push_back(pack(outer));
    ++flips;
  }
  return flips;
}

/// Splits the edge at v into two (at the border) or four triangles and legalizes around v.
template <PlanarPredicates P>
void split_side(PlanarTriangulation& t, PlanarSide s, VertexId v, const P& predicates) {
  const bool inner = neighbor(t, s) != none;
  const PlanarSide o = inner ? other_side(t, s) : PlanarSide{};
  const bool constrained = is_constrained(t, s);
  const VertexId a = edge_start(t, s), b = edge_end(t, s), c = apex(t, s);
  const Beyond bc = beyond(t, {s.triangle, next_corner(s.corner)});
  const Beyond ca = beyond(t, {s.triangle, previous_corner(s.corner)});
  const std::uint32_t first = s.triangle, second = append_triangle(t, v, b, c);
  std::vector<std::uint32_t> stack;
  if (!inner) {
    set_corners(t, first, a, v, c);
    attach(t, {first, 2}, {none, 0, constrained});
    attach(t, {second, 2}, {none, 0, constrained});
  } else {
    const VertexId d = apex(t, o);
    const Beyond ad = beyond(t, {o.triangle, next_corner(o.corner)});
    const Beyond db = beyond(t, {o.triangle, previous_corner(o.corner)});
    const std::uint32_t third = append_triangle(t, v, a, d), fourth = o.triangle;
    set_corners(t, first, a, v, c);
    set_corners(t, fourth, b, v, d);
    attach(t, {third, 0}, ad);
    attach(t, {fourth, 1}, db);
    join(t, {third, 1}, {fourth, 0}, false);
    join(t, {first, 2}, {third, 2}, constrained);
    join(t, {second, 2}, {fourth, 2}, constrained);
    stack = {pack({third, 0}), pack({fourth, 1})};
  }
  attach(t, {first, 1}, ca);
  attach(t, {second, 0}, bc);
  join(t, {first, 0}, {second, 1}, false);
  stack.insert(stack.end(), {pack({first, 1}), pack({second, 0})});
  legalize_from(t, stack, predicates);
}

/// Splits a triangle into three at v, which is strictly within, and legalizes around v.
template <PlanarPredicates P>
void split_triangle(PlanarTriangulation& t, std::uint32_t triangle, VertexId v, const P& predicates) {
  const auto [a, b, c] = t.triangles[triangle];
  const Beyond bc = beyond(t, {triangle, 0}), ca = beyond(t, {triangle, 1}), ab = beyond(t, {triangle, 2});
  const std::uint32_t at_ab = triangle, at_bc = append_triangle(t, b, c, v), at_ca = append_triangle(t, c, a, v);
  set_corners(t, at_ab, a, b, v);
  attach(t, {at_ab, 2}, ab);
  attach(t, {at_bc, 2}, bc);
  attach(t, {at_ca, 2}, ca);
  join(t, {at_ab, 0}, {at_bc, 1}, false);
  join(t, {at_bc, 0}, {at_ca, 1}, false);
  join(t, {at_ca, 0}, {at_ab, 1}, false);
  std::vector<std::uint32_t> stack{pack({at_ab, 2}), pack({at_bc, 2}), pack({at_ca, 2})};
  legalize_from(t, stack, predicates);
}

/// The signs of v against the three edges of a triangle; none is negative if v is in it or on its border.
template <PlanarPredicates P>
std::array<int, 3> signs_at_edges(const PlanarTriangulation& t, std::uint32_t triangle, VertexId v,
                                  const P& predicates) {
  const auto& [a, b, c] = t.triangles[triangle];
  return {predicates.orient(b, c, v), predicates.orient(c, a, v), predicates.orient(a, b, v)};
}

inline bool is_within(const std::array<int, 3>& signs) {
  return signs[0] >= 0 && signs[1] >= 0 && signs[2] >= 0;
}

/// A triangle that holds v, or none. Walks from `start`; if the walk meets a border or goes on for too long, all
/// triangles are searched.
template <PlanarPredicates P>
std::uint32_t locate(const PlanarTriangulation& t, VertexId v, std::uint32_t start, const P& predicates) {
  std::uint32_t triangle = start;
  for (std::size_t steps = 0; triangle != none && steps < t.triangles.size(); ++steps) {
    const std::array<int, 3> signs = signs_at_edges(t, triangle, v, predicates);
    if (is_within(signs)) return triangle;
    // Another edge first at each step, so that the walk cannot go in circles in a constrained triangulation for long.
    const auto first = static_cast<std::uint32_t>(steps % 3);
    const std::uint32_t second = next_corner(first), third = next_corner(second);
    const std::uint32_t corner = signs[first] < 0 ? first : signs[second] < 0 ? second : third;
    triangle = t.neighbors[triangle][corner];
  }
  for (triangle = 0; triangle < t.triangles.size(); ++triangle) {
    if (is_within(signs_at_edges(t, triangle, v, predicates))) return triangle;
  }
  return none;
}

}  // namespace ccdt::planar
