#include "engine/steiner/loosen_star.h"

#include <algorithm>

#include "engine/tets/shake_cells.h"
#include "engine/tets/swaps.h"

namespace ccdt::steiner {
namespace {

/// Removes an edge of a vertex. \return was there one that could be removed?
bool remove_an_edge(CellComplex& x, std::uint32_t vertex, Loosening& state) {
  state.star.gather_star(x, vertex);
  std::vector<std::uint32_t> tried = {vertex};
  for (const CellId c : state.star.cells()) {
    const auto& v = x.cell(c).vertices;
    for (std::uint32_t edge = 0; edge < delaunay::edge_corners.size(); ++edge) {
      const std::uint32_t from = v[delaunay::edge_corners[edge][0]], to = v[delaunay::edge_corners[edge][1]];
      if (from != vertex && to != vertex) continue;
      const std::uint32_t other = from == vertex ? to : from;
      if (tets::has(tried, other)) continue;
      tried.push_back(other);
      if (!plan_edge_removal(x, c, edge, 0, state.change) || !x.all_positive(state.change)) continue;
      x.apply(state.change, state.made);
      state.new_cells.insert(state.new_cells.end(), state.made.begin(), state.made.end());
      return true;
    }
  }
  return false;
}

}  // namespace

void loosen_star(CellComplex& x, std::uint32_t vertex, int shakes, Loosening& state) {
  shake_cells(x, vertex, shakes, 0, state.random, state.new_cells);
  while (remove_an_edge(x, vertex, state)) {
  }
}

void tidy_star(CellComplex& x, std::uint32_t vertex, Loosening& state) {
  auto& cells = state.new_cells;
  state.star.gather_star(x, vertex);
  cells.insert(cells.end(), state.star.cells().begin(), state.star.cells().end());
  std::ranges::sort(cells);
  const auto rest = std::ranges::unique(cells);
  cells.erase(rest.begin(), rest.end());
  for (const CellId c : cells) {
    if (x.is_dead(c) || x.quality(c) >= x.goal().good()) continue;
    if (plan_best_swap(x, c, state.scratch, state.change) != tets::Swap::none) x.apply(state.change, state.made);
  }
  cells.clear();
}

}  // namespace ccdt::steiner
