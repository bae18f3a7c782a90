#include "engine/tets/shake_cells.h"

#include "engine/tets/swaps.h"

namespace ccdt::tets {
namespace {

/// The cells to change are found by random walks that are shorter than this.
constexpr int most_walk_steps = 16;

constexpr std::uint32_t edges_of_cell = 6, faces_of_cell = 4;

}  // namespace

void CellShaker::shake(std::uint32_t vertex, int tries, double least, std::vector<std::uint32_t>& made) {
  for (int i = 0; i < tries; ++i) {
    const std::uint32_t cell = random_cell_near(vertex);
    const std::uint32_t choice = random_() % (edges_of_cell + faces_of_cell);
    const bool is_planned = choice < edges_of_cell
                                ? plan_edge_removal(x_, cell, choice, least, change_)
                                : plan_face_removal(x_, cell, choice - edges_of_cell, least, change_);
    if (!is_planned || !x_.all_positive(change_)) continue;
    x_.apply(change_, new_cells_);
    made.insert(made.end(), new_cells_.begin(), new_cells_.end());
  }
}

/// The end of a random walk from a cell of a vertex.
std::uint32_t CellShaker::random_cell_near(std::uint32_t vertex) {
  std::uint32_t cell = x_.cell_at(vertex);
  for (auto steps = random_() % most_walk_steps; steps > 0; --steps) {
    const std::uint32_t face = face_code(cell, random_() % 4);
    if (!x_.is_wall(face)) cell = cell_of(x_.across(face));
  }
  return cell;
}

}  // namespace ccdt::tets
