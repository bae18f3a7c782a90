#include "engine/improve/loosen_star.h"

#include <algorithm>
#include <array>

#include "engine/improve/smoothing.h"
#include "engine/improve/topological_changes.h"

namespace ccdt::improve {
namespace {

/// The cells to change are found by random walks that are shorter than this.
constexpr int most_walk_steps = 16;

constexpr std::uint32_t edges_of_cell = 6, faces_of_cell = 4;
constexpr std::uint32_t ends_of_edge[edges_of_cell][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

const std::vector<Freedom> nothing_moves;

template <class List>
void keep_one_of_each(List& list) {
  std::ranges::sort(list);
  const auto rest = std::ranges::unique(list);
  list.erase(rest.begin(), rest.end());
}

}  // namespace

StarLoosener::StarLoosener(CellComplex& x) : x_(x), swaps_(x, nothing_moves, Improvement::swap) {}

void StarLoosener::loosen(std::uint32_t vertex, int shakes) {
  shake(vertex, shakes);
  shrink(vertex);
}

bool StarLoosener::apply_if_positive(bool is_planned, const Change& change) {
  if (!is_planned || !x_.all_positive(change)) return false;
  x_.apply(change, made_);
  new_cells_.insert(new_cells_.end(), made_.begin(), made_.end());
  return true;
}

/// The end of a random walk from a cell of a vertex.
std::uint32_t StarLoosener::random_cell_near(std::uint32_t vertex) {
  std::uint32_t cell = x_.cell_at(vertex);
  for (auto steps = random_() % most_walk_steps; steps > 0; --steps) {
    const std::uint32_t face = face_code(cell, random_() % 4);
    if (!x_.is_wall(face)) cell = cell_of(x_.across(face));
  }
  return cell;
}

void StarLoosener::shake(std::uint32_t vertex, int shakes) {
  for (int i = 0; i < shakes; ++i) {
    const std::uint32_t cell = random_cell_near(vertex);
    const std::uint32_t choice = random_() % (edges_of_cell + faces_of_cell);
    apply_if_positive(choice < edges_of_cell ? plan_edge_removal(x_, cell, choice, 0, change_)
                                             : plan_face_removal(x_, cell, choice - edges_of_cell, 0, change_),
                      change_);
  }
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
    for (std::uint32_t edge = 0; edge < edges_of_cell; ++edge) {
      const auto [from, to] = ends_of_edge[edge];
      if (v[from] != vertex && v[to] != vertex) continue;
      const std::uint32_t other = v[from] == vertex ? v[to] : v[from];
      if (std::ranges::find(vertices_, other) != vertices_.end()) continue;
      vertices_.push_back(other);
      if (apply_if_positive(plan_edge_removal(x_, c, edge, 0, change_), change_)) return true;
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
    swaps_.find(c, false, Effort::usual, step_);
    if (step_.kind == Step::Kind::change) x_.apply(step_.change, made_);
  }
  new_cells_.clear();
}

}  // namespace ccdt::improve
