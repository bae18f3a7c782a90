#include "engine/planar/topology.h"

#include <algorithm>
#include <span>
#include <utility>

#include "engine/base/errors.h"
#include "engine/planar/triangulation.h"

namespace ccdt::planar {

namespace {

[[noreturn]] void fail(const char* what) {
  throw InputError(what, {}, "repair the facet's triangles: neighbors must share whole edges, two at most each");
}

/// Enters a constrained or border edge into the table, so that it is found without a search.
void register_edge(Triangulation& t, Side s) {
  if (is_constrained(t, s) || neighbor(t, s) == none) {
    t.known_edges.set(edge_key(edge_start(t, s), edge_end(t, s)), pack(s));
  }
}

/// The sides of some triangles, found by direction.
class SidesByDirection {
 public:
  SidesByDirection(const Triangulation& t, const std::vector<std::uint32_t>& triangles) {
    sides_.reserve(3 * triangles.size());
    for (std::uint32_t triangle : triangles) {
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const Side s{triangle, corner};
        sides_.emplace_back(directed_key(edge_start(t, s), edge_end(t, s)), pack(s));
      }
    }
    std::sort(sides_.begin(), sides_.end());
  }

  std::optional<Side> find(VertexId from, VertexId to) const {
    const std::uint64_t key = directed_key(from, to);
    const auto at = std::lower_bound(sides_.begin(), sides_.end(), std::pair(key, std::uint32_t{0}));
    if (at == sides_.end() || at->first != key) return std::nullopt;
    return unpack(at->second);
  }

 private:
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sides_;
};

struct BorderEdge {
  VertexId from, to;  ///< with the channel on its left
  Adjacency across;
};

}  // namespace

std::uint32_t corner_of(const Triangulation& t, std::uint32_t triangle, VertexId v) {
  const std::array<VertexId, 3>& corners = t.triangles[triangle];
  return corners[0] == v ? 0 : corners[1] == v ? 1 : corners[2] == v ? 2 : 3;
}

Side other_side(const Triangulation& t, Side s) {
  const std::uint32_t triangle = neighbor(t, s);
  return {triangle, next_corner(corner_of(t, triangle, edge_start(t, s)))};
}

Adjacency adjacency_at(const Triangulation& t, Side s) {
  const bool constrained = is_constrained(t, s);
  if (neighbor(t, s) == none) return {none, 0, constrained};
  const Side other = other_side(t, s);
  return {other.triangle, other.corner, constrained};
}

void attach(Triangulation& t, Side s, const Adjacency& across) {
  t.neighbors[s.triangle][s.corner] = across.neighbor;
  t.constrained[s.triangle][s.corner] = across.constrained;
  if (across.neighbor != none) {
    t.neighbors[across.neighbor][across.corner] = s.triangle;
    t.constrained[across.neighbor][across.corner] = across.constrained;
  }
  register_edge(t, s);
}

void join(Triangulation& t, Side s, Side other, bool constrained) {
  attach(t, s, {other.triangle, other.corner, constrained});
}

std::uint32_t append_triangle(Triangulation& t, VertexId a, VertexId b, VertexId c) {
  const auto triangle = static_cast<std::uint32_t>(t.triangles.size());
  t.triangles.emplace_back();
  t.neighbors.push_back({none, none, none});
  t.constrained.push_back({false, false, false});
  set_corners(t, triangle, a, b, c);
  return triangle;
}

void set_corners(Triangulation& t, std::uint32_t triangle, VertexId a, VertexId b, VertexId c) {
  t.triangles[triangle] = {a, b, c};
  for (VertexId v : {a, b, c}) t.triangle_of_vertex.set(v, triangle);
}

std::array<Side, 4> flip(Triangulation& t, Side s) {
  const Side o = other_side(t, s);
  const VertexId a = edge_start(t, s), b = edge_end(t, s), c = apex(t, s), d = apex(t, o);
  const Adjacency bc = adjacency_at(t, {s.triangle, next_corner(s.corner)});
  const Adjacency ca = adjacency_at(t, {s.triangle, previous_corner(s.corner)});
  const Adjacency ad = adjacency_at(t, {o.triangle, next_corner(o.corner)});
  const Adjacency db = adjacency_at(t, {o.triangle, previous_corner(o.corner)});
  // c and d keep both triangles, so their table entries stay valid; a and b lose one.
  t.triangles[s.triangle] = {c, a, d};
  t.triangles[o.triangle] = {d, b, c};
  t.triangle_of_vertex.set(a, s.triangle);
  t.triangle_of_vertex.set(b, o.triangle);
  // The triangles could be neighbors across a second edge only if a vertex were on that edge's line: never.
  attach(t, {s.triangle, 2}, ca);
  attach(t, {s.triangle, 0}, ad);
  attach(t, {o.triangle, 2}, db);
  attach(t, {o.triangle, 0}, bc);
  join(t, {s.triangle, 1}, {o.triangle, 1}, false);
  return {Side{s.triangle, 0}, {s.triangle, 2}, {o.triangle, 0}, {o.triangle, 2}};
}

void replace_channel(Triangulation& t, const std::vector<std::uint32_t>& channel, const std::vector<Side>& border,
                     const std::vector<std::array<VertexId, 3>>& triangles) {
  std::vector<BorderEdge> edges;
  edges.reserve(border.size());
  for (Side s : border) edges.push_back({edge_start(t, s), edge_end(t, s), adjacency_at(t, s)});

  for (std::size_t i = 0; i < channel.size(); ++i) {
    set_corners(t, channel[i], triangles[i][0], triangles[i][1], triangles[i][2]);
  }
  const SidesByDirection sides(t, channel);
  for (std::uint32_t triangle : channel) {
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const Side s{triangle, corner};
      const std::optional<Side> other = sides.find(edge_end(t, s), edge_start(t, s));
      if (other) join(t, s, *other, false);
    }
  }
  for (const BorderEdge& edge : edges) {
    const Side s = *sides.find(edge.from, edge.to);
    if (sides.find(edge.to, edge.from)) {
      // A spike: an edge that is not crossed but has the channel on both sides. Only its constraint must be kept.
      set_constrained(t, s, edge.across.constrained);
    } else {
      attach(t, s, edge.across);
    }
  }
}

Triangulation from_triangles(std::span<const std::array<VertexId, 3>> triangles,
                             std::span<const Edge> constrained_edges, std::size_t room) {
  Triangulation t;
  const std::size_t most = triangles.size() + room;
  t.triangles.reserve(most), t.neighbors.reserve(most), t.constrained.reserve(most);
  t.triangles.assign(triangles.begin(), triangles.end());
  t.neighbors.assign(triangles.size(), {none, none, none});
  t.constrained.assign(triangles.size(), {false, false, false});
  t.triangle_of_vertex.reserve(most / 2 + 3);

  t.known_edges.reserve(3 * most / 2 + 2);
  for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle) {
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const Side s{triangle, corner};
      const VertexId from = edge_start(t, s), to = edge_end(t, s);
      if (from == to) fail("a triangle of a facet has the same vertex twice");
      if (const auto [first, is_new] = t.known_edges.insert(edge_key(from, to), pack(s)); !is_new) {
        const Side other = unpack(*first);
        if (edge_start(t, other) == from || neighbor(t, other) != none)
          fail("two triangles of a facet lie on the same side of an edge");
        t.neighbors[triangle][corner] = other.triangle;
        t.neighbors[other.triangle][other.corner] = triangle;
      }
      t.triangle_of_vertex.set(apex(t, s), triangle);
    }
  }
  for (const auto& [a, b] : constrained_edges) {
    const std::uint32_t* packed = t.known_edges.find(edge_key(a, b));
    if (packed == nullptr) fail("a constrained edge of a facet is not an edge of its triangles");
    const Side s = unpack(*packed);
    set_constrained(t, edge_start(t, s) == a || neighbor(t, s) == none ? s : other_side(t, s), true);
  }
  return t;
}

std::optional<Side> find_edge(const Triangulation& t, VertexId a, VertexId b) {
  const std::uint32_t known = t.known_edges.get(edge_key(a, b), none);
  if (known != none) {
    // Entries are not removed when an edge is split or flipped, so they must be checked.
    const Side s = unpack(known);
    if (s.triangle < t.triangles.size() && edge_key(edge_start(t, s), edge_end(t, s)) == edge_key(a, b)) return s;
  }
  std::optional<Side> found;
  const auto has_edge = [&](std::uint32_t triangle, std::uint32_t corner) {
    const Side before{triangle, previous_corner(corner)}, after{triangle, next_corner(corner)};
    if (edge_end(t, before) == b) found = before;
    if (edge_start(t, after) == b) found = after;
    return found.has_value();
  };
  // A border edge would have been in the table, so this is an inner edge, which is in one fan of each of its ends. At a
  // pinched vertex, the search continues through all triangles.
  visit_star(t, a, has_edge);
  return found;
}

bool has_vertex(const Triangulation& t, VertexId v) {
  return t.triangle_of_vertex.contains(v);
}

void set_constrained(Triangulation& t, Side side, bool constrained) {
  Adjacency across = adjacency_at(t, side);
  across.constrained = constrained;
  attach(t, side, across);
}

std::vector<Edge> border_edges(const Triangulation& t) {
  std::vector<Edge> edges;
  for (std::uint32_t packed = 0; packed < 3 * t.triangles.size(); ++packed) {
    const Side s = unpack(packed);
    const VertexId from = edge_start(t, s), to = edge_end(t, s);
    if (neighbor(t, s) == none) edges.push_back({std::min(from, to), std::max(from, to)});
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// ---- Carving --------------------------------------------------------------------------------------------------------

namespace {

/// Spreads from the triangles in `stack`, which are marked, over all unmarked ones that are not behind a constraint;
/// returns the unmarked triangles behind constraints.
template <class IsMarked, class Mark>
std::vector<std::uint32_t> flood(const Triangulation& t, std::vector<std::uint32_t> stack, IsMarked is_marked,
                                 Mark mark) {
  std::vector<std::uint32_t> behind;
  while (!stack.empty()) {
    const std::uint32_t triangle = stack.back();
    stack.pop_back();
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t next = t.neighbors[triangle][corner];
      if (next == none || is_marked(next)) continue;
      if (t.constrained[triangle][corner]) {
        behind.push_back(next);
      } else {
        mark(next);
        stack.push_back(next);
      }
    }
  }
  return behind;
}

/// For each triangle, the least number of constraints between it and the outside.
std::vector<std::uint32_t> nesting_depths(const Triangulation& t) {
  std::vector<std::uint32_t> depths(t.triangles.size(), none);
  std::uint32_t depth = 0;
  const auto is_marked = [&](std::uint32_t triangle) { return depths[triangle] != none; };
  const auto mark = [&](std::uint32_t triangle) { depths[triangle] = depth; };

  std::vector<std::uint32_t> here, behind;
  for (const Edge& edge : border_edges(t)) {
    const Side s = unpack(t.known_edges.get(edge_key(edge[0], edge[1]), none));
    (is_constrained(t, s) ? behind : here).push_back(s.triangle);
  }
  while (!here.empty() || !behind.empty()) {
    for (std::uint32_t triangle : here) mark(triangle);
    const std::vector<std::uint32_t> further = flood(t, here, is_marked, mark);
    behind.insert(behind.end(), further.begin(), further.end());
    std::erase_if(behind, is_marked);
    here = std::move(behind);
    behind.clear();
    ++depth;
  }
  return depths;
}

}  // namespace

std::vector<bool> choose_inside(const Triangulation& t, bool nested) {
  const std::vector<std::uint32_t> depths = nesting_depths(t);
  std::vector<bool> keep(depths.size());
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = nested ? depths[i] % 2 == 1 : depths[i] > 0;
  return keep;
}

void flood_hole(const Triangulation& t, std::uint32_t seed, std::vector<bool>& keep) {
  std::vector<bool> reached(t.triangles.size(), false);
  const auto mark = [&](std::uint32_t triangle) {
    reached[triangle] = true;
    keep[triangle] = false;
  };
  mark(seed);
  flood(
      t, {seed}, [&](std::uint32_t triangle) { return reached[triangle]; }, mark);
}

Triangulation keep_triangles(const Triangulation& t, const std::vector<bool>& keep) {
  std::vector<std::array<VertexId, 3>> triangles;
  std::vector<Edge> constrained;
  for (std::uint32_t triangle = 0; triangle < t.triangles.size(); ++triangle) {
    if (!keep[triangle]) continue;
    triangles.push_back(t.triangles[triangle]);
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const Side s{triangle, corner};
      if (is_constrained(t, s)) constrained.push_back({edge_start(t, s), edge_end(t, s)});
    }
  }
  return from_triangles(triangles, constrained);
}

}  // namespace ccdt::planar
