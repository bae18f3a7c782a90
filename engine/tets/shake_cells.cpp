#include "engine/tets/shake_cells.h"

#include "engine/tets/swaps.h"

namespace ccdt::tets {
namespace {

/// The cells to change are found by random walks shorter than this.
constexpr int most_walk_steps = 16;

constexpr std::uint32_t edges_of_cell = 6, faces_of_cell = 4;

/// The end of a random walk from a cell of a vertex.
CellId random_cell_near(const CellComplex& x, std::uint32_t vertex, std::mt19937& random) {
  CellId cell = x.cell_at(vertex);
  for (auto steps = random() % most_walk_steps; steps > 0; --steps) {
    const std::uint32_t face = face_code(cell, random() % faces_of_cell);
    if (!x.is_wall(face)) cell = cell_of(x.across(face));
  }
  return cell;
}

}  // namespace

void shake_cells(CellComplex& x, std::uint32_t vertex, int tries, double least, std::mt19937& random,
                 std::vector<CellId>& made) {
  Change change;
  std::vector<CellId> new_cells;
  for (int i = 0; i < tries; ++i) {
    const CellId cell = random_cell_near(x, vertex, random);
    const std::uint32_t choice = random() % (edges_of_cell + faces_of_cell);
    const bool is_planned = choice < edges_of_cell ? plan_edge_removal(x, cell, choice, least, change)
                                                   : plan_face_removal(x, cell, choice - edges_of_cell, least, change);
    if (!is_planned || !x.all_positive(change)) continue;
    x.apply(change, new_cells);
    made.insert(made.end(), new_cells.begin(), new_cells.end());
  }
}

}  // namespace ccdt::tets
