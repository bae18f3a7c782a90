#include "engine/steiner/loosen_star.h"

#include <algorithm>
#include <array>

#include "engine/tets/swaps.h"
#include "engine/tets/vertex_star.h"

namespace ccdt::steiner {
namespace {

template <class List>
void keep_one_of_each(List& list) {
  std::ranges::sort(list);
  const auto rest = std::ranges::unique(list);
  list.erase(rest.begin(), rest.end());
}

}  // namespace

StarLoosener::StarLoosener(CellComplex& x) : x_(x), shaker_(x) {}

void StarLoosener::loosen(std::uint32_t vertex, int shakes) {
  shaker_.shake(vertex, shakes, 0, new_cells_);
  shrink(vertex);
}

void StarLoosener::shrink(std::uint32_t vertex) {
  do {
    gather_cells(x_, vertex, marks_, star_);
  } while (remove_an_edge(vertex));
}

/// Removes an edge of a vertex whose cells are in the star. \return was there one that could be removed?
bool StarLoosener::remove_an_edge(std::uint32_t vertex) {
  vertices_.assign(1, vertex);
  for (const std::uint32_t c : star_) {
    const auto& v = x_.cell(c).vertices;
    for (std::uint32_t edge = 0; edge < delaunay::edge_corners.size(); ++edge) {
      const std::uint32_t from = delaunay::edge_corners[edge][0], to = delaunay::edge_corners[edge][1];
      if (v[from] != vertex && v[to] != vertex) continue;
      const std::uint32_t other = v[from] == vertex ? v[to] : v[from];
      if (std::ranges::find(vertices_, other) != vertices_.end()) continue;
      vertices_.push_back(other);
      if (!plan_edge_removal(x_, c, edge, 0, change_) || !x_.all_positive(change_)) continue;
      x_.apply(change_, made_);
      new_cells_.insert(new_cells_.end(), made_.begin(), made_.end());
      return true;
    }
  }
  return false;
}

void StarLoosener::tidy(std::uint32_t vertex) {
  gather_cells(x_, vertex, marks_, star_);
  new_cells_.insert(new_cells_.end(), star_.begin(), star_.end());
  keep_one_of_each(new_cells_);
  for (const std::uint32_t c : new_cells_) {
    if (x_.is_dead(c) || x_.quality(c) >= goal_quality(x_.goal())) continue;
    Box space_taken = empty_box;
    if (plan_best_swap(x_, c, scratch_, change_, space_taken) != tets::Swap::none) x_.apply(change_, made_);
  }
  new_cells_.clear();
}

}  // namespace ccdt::steiner
