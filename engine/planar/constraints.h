#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/planar/topology.h"
#include "engine/planar/triangulation.h"

namespace ccdt::planar {
/// Starts at the given sides and flips until all of them, and all edges that the flips change, are locally Delaunay. A
/// side in the stack stands for whatever edge is there when its turn comes; a flip pushes all edges that it moves
/// again.
template <Predicates P>
void legalize_from(Triangulation& t, std::vector<std::uint32_t>& stack, const P& predicates) {
  while (!stack.empty()) {
    const Side s = unpack(stack.back());
    stack.pop_back();
    if (is_constrained(t, s) || neighbor(t, s) == none) continue;
    ++work_done.edges_tested;
    const VertexId a = edge_start(t, s), b = edge_end(t, s), c = apex(t, s), d = apex(t, other_side(t, s));
    if (predicates.incircle(a, b, c, d) <= 0) continue;
    // Exact predicates in one plane never fail this test. It keeps the triangles valid if the caller's predicates are
    // only nearly those of a plane.
    if (predicates.orient(c, a, d) <= 0 || predicates.orient(d, b, c) <= 0) continue;
    for (Side outer : flip(t, s)) stack.push_back(pack(outer));
    ++work_done.edges_flipped;
  }
}

/// Splits the edge at v into two (at the border) or four triangles and legalizes around v.
template <Predicates P>
void split_side(Triangulation& t, Side s, VertexId v, const P& predicates) {
  const bool inner = neighbor(t, s) != none;
  const Side o = inner ? other_side(t, s) : Side{};
  const bool constrained = is_constrained(t, s);
  const VertexId a = edge_start(t, s), b = edge_end(t, s), c = apex(t, s);
  const Adjacency bc = adjacency_at(t, {s.triangle, next_corner(s.corner)});
  const Adjacency ca = adjacency_at(t, {s.triangle, previous_corner(s.corner)});
  const std::uint32_t first = s.triangle, second = append_triangle(t, v, b, c);
  std::vector<std::uint32_t> stack;
  stack.reserve(16);
  if (!inner) {
    set_corners(t, first, a, v, c);
    attach(t, {first, 2}, {none, 0, constrained});
    attach(t, {second, 2}, {none, 0, constrained});
  } else {
    const VertexId d = apex(t, o);
    const Adjacency ad = adjacency_at(t, {o.triangle, next_corner(o.corner)});
    const Adjacency db = adjacency_at(t, {o.triangle, previous_corner(o.corner)});
    const std::uint32_t third = append_triangle(t, v, a, d), fourth = o.triangle;
    set_corners(t, first, a, v, c);
    set_corners(t, fourth, b, v, d);
    attach(t, {third, 0}, ad);
    attach(t, {fourth, 1}, db);
    join(t, {third, 1}, {fourth, 0}, false);
    join(t, {first, 2}, {third, 2}, constrained);
    join(t, {second, 2}, {fourth, 2}, constrained);
    stack.insert(stack.end(), {pack({third, 0}), pack({fourth, 1})});
  }
  attach(t, {first, 1}, ca);
  attach(t, {second, 0}, bc);
  join(t, {first, 0}, {second, 1}, false);
  stack.insert(stack.end(), {pack({first, 1}), pack({second, 0})});
  legalize_from(t, stack, predicates);
}

/// The signs of v against the three edges of a triangle; none is negative if v is in it or on its border.
template <Predicates P>
std::array<int, 3> signs_at_edges(const Triangulation& t, std::uint32_t triangle, VertexId v, const P& predicates) {
  const auto& [a, b, c] = t.triangles[triangle];
  return {predicates.orient(b, c, v), predicates.orient(c, a, v), predicates.orient(a, b, v)};
}

inline bool is_within(const std::array<int, 3>& signs) {
  return signs[0] >= 0 && signs[1] >= 0 && signs[2] >= 0;
}

/// A triangle that holds v, or none. Found by a walk; if it meets a border or takes too long, all triangles are
/// searched.
template <Predicates P>
std::uint32_t locate(const Triangulation& t, VertexId v, const P& predicates) {
  std::uint32_t triangle = 0;
  for (std::size_t steps = 0; triangle != none && steps < t.triangles.size(); ++steps) {
    ++work_done.triangles_visited;
    const std::array<int, 3> signs = signs_at_edges(t, triangle, v, predicates);
    if (is_within(signs)) return triangle;
    // Starts with a different edge at each step, so that the walk cannot circle for long in a constrained
    // triangulation.
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

/// How the ray from a vertex a toward b leaves the triangles around a.
struct RayExit {
  enum class Kind { nowhere, along_edge, through_edge } kind = Kind::nowhere;
  Side side;     ///< the edge that it runs along or leaves through (seen from inside)
  VertexId end;  ///< the far end of the edge that it runs along
};

template <Predicates P>
RayExit find_ray_exit(const Triangulation& t, VertexId a, VertexId b, const P& predicates) {
  RayExit exit;
  visit_star(t, a, [&](std::uint32_t triangle, std::uint32_t corner) {
    const VertexId right = t.triangles[triangle][next_corner(corner)];
    const VertexId left = t.triangles[triangle][previous_corner(corner)];
    const int at_right = right == b ? 0 : predicates.orient(a, right, b);
    const int at_left = left == b ? 0 : predicates.orient(a, b, left);
    if (at_right == 0 && (right == b || at_left > 0)) {
      exit = {RayExit::Kind::along_edge, {triangle, previous_corner(corner)}, right};
    } else if (at_left == 0 && (left == b || at_right > 0)) {
      exit = {RayExit::Kind::along_edge, {triangle, next_corner(corner)}, left};
    } else if (at_right > 0 && at_left > 0) {
      exit = {RayExit::Kind::through_edge, {triangle, corner}, VertexId()};
    }
    return exit.kind != RayExit::Kind::nowhere;
  });
  return exit;
}

/// The triangles that a new edge crosses, and the vertex or obstacle at their end.
struct Channel {
  std::vector<std::uint32_t> triangles;  ///< from start to end
  /// The edges of these triangles that are not crossed, from start to end, seen from inside.
  std::vector<Side> left, right;
  VertexId end;   ///< the vertex on the line where the channel ends; none if there is an obstacle
  Side obstacle;  ///< a constrained or border edge that is crossed
};

template <Predicates P>
Channel walk_channel(const Triangulation& t, VertexId a, VertexId b, Side crossed, const P& predicates) {
  Channel channel;
  channel.triangles.push_back(crossed.triangle);
  channel.right.push_back({crossed.triangle, previous_corner(crossed.corner)});
  channel.left.push_back({crossed.triangle, next_corner(crossed.corner)});
  for (;;) {
    if (is_constrained(t, crossed) || neighbor(t, crossed) == none) {
      channel.obstacle = crossed;
      return channel;
    }
    const Side entry = other_side(t, crossed);  // runs from left to right as seen along ab
    const VertexId v = apex(t, entry);
    const Side right_edge{entry.triangle, next_corner(entry.corner)};
    const Side left_edge{entry.triangle, previous_corner(entry.corner)};
    channel.triangles.push_back(entry.triangle);
    const int side = v == b ? 0 : predicates.orient(a, b, v);
    if (side <= 0) channel.right.push_back(right_edge);
    if (side >= 0) channel.left.push_back(left_edge);
    if (side == 0) {
      channel.end = v;
      return channel;
    }
    crossed = side > 0 ? right_edge : left_edge;
  }
}

/// Triangulates the polygon between a chain of edges and the straight line from its start to its end, which sees the
/// whole chain: whenever the last two edges of the chain so far turn toward the line, their triangle is cut off
/// (Toussaint & Avis 1982 on polygons that are visible from an edge). `turn` is +1 for a chain on the right of the
/// line, -1 on the left.
template <Predicates P>
void triangulate_beside(const std::vector<VertexId>& chain, int turn, const P& predicates,
                        std::vector<std::array<VertexId, 3>>& triangles) {
  std::vector<VertexId> stack;
  for (VertexId v : chain) {
    while (stack.size() >= 2) {
      const VertexId top = stack.back(), below = stack[stack.size() - 2];
      if (v == below || predicates.orient(below, top, v) != turn) break;
      if (turn > 0) {
        triangles.push_back({below, top, v});
      } else {
        triangles.push_back({top, below, v});
      }
      stack.pop_back();
    }
    stack.push_back(v);
  }
}

/// Clears the channel for the edge from its start to its end: this becomes an edge, with an arbitrary triangulation on
/// both sides.
template <Predicates P>
void cut_through(Triangulation& t, VertexId a, const Channel& channel, const P& predicates) {
  std::vector<std::array<VertexId, 3>> triangles;
  std::vector<VertexId> chain{a};
  for (Side s : channel.right) chain.push_back(edge_end(t, s));
  triangulate_beside(chain, +1, predicates, triangles);
  chain = {a};
  for (Side s : channel.left) chain.push_back(edge_start(t, s));
  triangulate_beside(chain, -1, predicates, triangles);

  std::vector<Side> border = channel.right;
  border.insert(border.end(), channel.left.begin(), channel.left.end());
  replace_channel(t, channel.triangles, border, triangles);
}

/// An edge of the triangulation, and the number of the input edge that it is part of.
struct NumberedPart {
  Edge edge;
  std::size_t number;
};

inline std::size_t number_of_part(const std::vector<NumberedPart>& parts, Edge edge) {
  const Edge reversed{edge[1], edge[0]};
  for (const NumberedPart& part : parts) {
    if (part.edge == edge || part.edge == reversed) return part.number;
  }
  throw std::logic_error("a constrained edge comes from no edge of the input");
}

/// Inserts all edges. If two edges cross, the result says so and has no triangulation.
template <Predicates P>
void insert_edges(TriangulationResult& result, std::span<const Edge> edges, const P& predicates) {
  std::vector<NumberedPart> parts;
  for (std::size_t number = 0; number < edges.size(); ++number) {
    const auto& [a, b] = edges[number];
    if (!has_vertex(result.triangulation, a) || !has_vertex(result.triangulation, b)) {
      throw std::invalid_argument("an edge ends in a vertex that is not among the vertices");
    }
    const ConstraintResult constraint = insert_constraint(result.triangulation, a, b, predicates);
    if (!constraint.inserted) {
      result.status = TriangulationResult::Status::crossing;
      result.crossing = {number_of_part(parts, constraint.obstacle), number};
      result.triangulation = {};
      return;
    }
    for (const Edge& part : constraint.parts) parts.push_back({part, number});
  }
}

template <Predicates P>
void legalize(Triangulation& t, const P& predicates) {
  std::vector<std::uint32_t> stack;
  for (std::uint32_t packed = 0; packed < 3 * t.triangles.size(); ++packed) {
    const Side s = unpack(packed);
    const std::uint32_t other = neighbor(t, s);
    if (other != none && s.triangle < other) stack.push_back(packed);
  }
  legalize_from(t, stack, predicates);
}

template <Predicates P>
bool split_edge(Triangulation& t, VertexId a, VertexId b, VertexId v, const P& predicates) {
  const std::optional<Side> side = find_edge(t, a, b);
  if (!side) return false;
  split_side(t, *side, v, predicates);
  return true;
}

template <Predicates P>
ConstraintResult insert_constraint(Triangulation& t, VertexId a, VertexId b, const P& predicates) {
  ConstraintResult result;
  while (a != b) {
    RayExit exit = find_ray_exit(t, a, b, predicates);
    if (exit.kind == RayExit::Kind::nowhere) return {false, std::move(result.parts), {a, a}};
    std::vector<std::uint32_t> to_check;
    if (exit.kind == RayExit::Kind::through_edge) {
      const Channel channel = walk_channel(t, a, b, exit.side, predicates);
      if (channel.end.is_none())
        return {false, std::move(result.parts), {edge_start(t, channel.obstacle), edge_end(t, channel.obstacle)}};
      cut_through(t, a, channel, predicates);
      for (std::uint32_t triangle : channel.triangles) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) to_check.push_back(pack({triangle, corner}));
      }
      exit.side = *find_edge(t, a, channel.end);
      exit.end = channel.end;
    }
    set_constrained(t, exit.side, true);
    legalize_from(t, to_check, predicates);
    result.parts.push_back({a, exit.end});
    a = exit.end;
  }
  return result;
}

template <Predicates P>
TriangulationResult triangulate(std::span<const VertexId> vertices, std::span<const Edge> edges, const P& predicates,
                                const Carving& carving) {
  TriangulationResult result = delaunay(vertices, predicates);
  if (!result) return result;
  insert_edges(result, edges, predicates);
  if (!result) return result;

  Triangulation& t = result.triangulation;
  std::vector<bool> keep = choose_inside(t, carving.nested);
  for (VertexId seed : carving.hole_seeds) {
    const std::uint32_t triangle = locate(t, seed, predicates);
    if (triangle == none) {
      result.lost_seeds.push_back(seed);
    } else {
      flood_hole(t, triangle, keep);
    }
  }
  if (std::find(keep.begin(), keep.end(), false) != keep.end()) t = keep_triangles(t, keep);
  for (VertexId v : vertices) {
    if (!has_vertex(t, v)) result.unused.push_back(v);
  }
  return result;
}

}  // namespace ccdt::planar
