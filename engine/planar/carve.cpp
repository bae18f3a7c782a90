#include <algorithm>
#include <span>

#include "engine/planar/topology.h"
#include "engine/planar/triangulation.h"

namespace ccdt::planar {
namespace {

/// Spreads from the triangles in `stack`, which are marked, over all that are unmarked and not behind a constraint;
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

/// For each triangle how many constraints at least are between it and the outside.
std::vector<std::uint32_t> nesting_depths(const Triangulation& t) {
  std::vector<std::uint32_t> depths(t.triangles.size(), none);
  std::uint32_t depth = 0;
  const auto is_marked = [&](std::uint32_t triangle) { return depths[triangle] != none; };
  const auto mark = [&](std::uint32_t triangle) { depths[triangle] = depth; };

  std::vector<std::uint32_t> here, behind;
  for (const Edge& edge : border_edges(t)) {
    const Side s = unpack(t.fixed_edges.get(edge_key(edge[0], edge[1]), none));
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

std::vector<bool> choose_inside(const Triangulation& t, Carving::Outside outside) {
  std::vector<bool> keep(t.triangles.size(), true);
  if (outside == Carving::Outside::keep) return keep;
  const std::vector<std::uint32_t> depths = nesting_depths(t);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    keep[i] = outside == Carving::Outside::remove ? depths[i] > 0 : depths[i] % 2 == 1;
  }
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
