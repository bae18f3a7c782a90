#pragma once

#include <algorithm>

#include "engine/planar/local_steps.h"
#include "engine/planar/topology.h"
#include "engine/planar/triangulation.h"

namespace ccdt {
namespace planar {

/// How the ray from a vertex a towards b leaves the triangles around a.
struct Departure {
  enum class Kind { nowhere, along_edge, through_edge } kind = Kind::nowhere;
  PlanarSide side;  ///< the edge that it runs along, or through which it leaves (seen from inside)
  VertexId end;     ///< the far end of the edge that it runs along
};

template <PlanarPredicates P>
Departure depart(const PlanarTriangulation& t, VertexId a, VertexId b, const P& predicates) {
  Departure d;
  visit_star(t, a, [&](std::uint32_t triangle, std::uint32_t corner) {
    const VertexId right = t.triangles[triangle][next_corner(corner)];
    const VertexId left = t.triangles[triangle][previous_corner(corner)];
    const int at_right = right == b ? 0 : predicates.orient(a, right, b);
    const int at_left = left == b ? 0 : predicates.orient(a, b, left);
    if (at_right == 0 && (right == b || at_left > 0)) {
      d = {Departure::Kind::along_edge, {triangle, previous_corner(corner)}, right};
    } else if (at_left == 0 && (left == b || at_right > 0)) {
      d = {Departure::Kind::along_edge, {triangle, next_corner(corner)}, left};
    } else if (at_right > 0 && at_left > 0) {
      d = {Departure::Kind::through_edge, {triangle, corner}, VertexId()};
    }
    return d.kind != Departure::Kind::nowhere;
  });
  return d;
}

/// The triangles that an edge to be inserted crosses, and what it finds at their end.
struct Channel {
  std::vector<std::uint32_t> triangles;  ///< from start to end
  std::vector<PlanarSide> left,
      right;            ///< the edges of these triangles that are not crossed, from start to end, seen from inside
  VertexId end;         ///< the vertex on the line where the channel ends; none: there is an obstacle
  PlanarSide obstacle;  ///< a constrained or border edge that is crossed
};

template <PlanarPredicates P>
Channel walk_channel(const PlanarTriangulation& t, VertexId a, VertexId b, PlanarSide crossed, const P& predicates) {
  Channel channel;
  channel.triangles.push_back(crossed.triangle);
  channel.right.push_back({crossed.triangle, previous_corner(crossed.corner)});
  channel.left.push_back({crossed.triangle, next_corner(crossed.corner)});
  for (;;) {
    if (is_constrained(t, crossed) || neighbor(t, crossed) == none) {
      channel.obstacle = crossed;
      return channel;
    }
    const PlanarSide entry = other_side(t, crossed);  // runs from left to right as seen along ab
    const VertexId v = apex(t, entry);
    const PlanarSide right_edge{entry.triangle, next_corner(entry.corner)};
    const PlanarSide left_edge{entry.triangle, previous_corner(entry.corner)};
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

/// Triangulates what lies between a chain of edges and the straight line from its start to its end, which sees all of
/// the chain: whenever the last two edges of the chain so far turn towards the line, their triangle is cut off
/// (Toussaint & Avis 1982 on polygons that are visible from an edge). `turn` is +1 for a chain on the right of the
/// line, -1 on the left.
template <PlanarPredicates P>
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

/// Clears the channel for the edge from its start to its end: afterwards that is an edge, and the triangles on both
/// sides are some triangulation.
template <PlanarPredicates P>
void cut_through(PlanarTriangulation& t, VertexId a, const Channel& channel, const P& predicates) {
  std::vector<std::array<VertexId, 3>> triangles;
  std::vector<VertexId> chain{a};
  for (PlanarSide s : channel.right) chain.push_back(edge_end(t, s));
  triangulate_beside(chain, +1, predicates, triangles);
  chain = {a};
  for (PlanarSide s : channel.left) chain.push_back(edge_start(t, s));
  triangulate_beside(chain, -1, predicates, triangles);

  std::vector<PlanarSide> border = channel.right;
  border.insert(border.end(), channel.left.begin(), channel.left.end());
  replace_channel(t, channel.triangles, border, triangles);
}

}  // namespace planar

template <PlanarPredicates P>
PlanarConstraintResult planar_insert_constraint(PlanarTriangulation& t, VertexId a, VertexId b, const P& predicates) {
  using planar::Departure;
  PlanarConstraintResult result;
  while (a != b) {
    Departure departure = planar::depart(t, a, b, predicates);
    if (departure.kind == Departure::Kind::nowhere) {
      result.status = PlanarConstraintResult::Status::outside;
      result.obstacle = {a, a};
      return result;
    }
    std::vector<std::uint32_t> to_check;
    if (departure.kind == Departure::Kind::through_edge) {
      const planar::Channel channel = planar::walk_channel(t, a, b, departure.side, predicates);
      if (channel.end.is_none()) {
        const bool constrained = planar::is_constrained(t, channel.obstacle);
        result.status = constrained && planar::neighbor(t, channel.obstacle) != planar::none
                            ? PlanarConstraintResult::Status::crossing
                            : PlanarConstraintResult::Status::outside;
        result.obstacle = {planar::edge_start(t, channel.obstacle), planar::edge_end(t, channel.obstacle)};
        return result;
      }
      planar::cut_through(t, a, channel, predicates);
      for (std::uint32_t triangle : channel.triangles) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) to_check.push_back(planar::pack({triangle, corner}));
      }
      departure.side = *planar_find_edge(t, a, channel.end);
      departure.end = channel.end;
    }
    planar_set_constrained(t, departure.side, true);
    planar::legalize_from(t, to_check, predicates);
    result.parts.push_back({a, departure.end});
    a = departure.end;
  }
  return result;
}

}  // namespace ccdt
