#include "engine/delaunay/cell_star.h"

#include <algorithm>

#include "engine/numbers/predicates.h"

namespace ccdt::delaunay {
namespace {

/// The place of v among the vertices of the cell, 4 if it is not there.
std::uint32_t place_of(const Cell& cell, std::uint32_t v) {
  std::uint32_t i = 0;
  while (i < 4 && cell.vertices[i] != v) ++i;
  return i;
}

}  // namespace

std::span<const std::uint32_t> CellStar::around(std::uint32_t vertex) {
  seen_.resize(d_.cells.size(), search_);
  if (++search_ == 0) {
    std::fill(seen_.begin(), seen_.end(), 0);
    search_ = 1;
  }
  cells_.assign(1, d_.vertices[vertex].cell);
  seen_[cells_[0]] = search_;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = d_.cells[cells_[i]];
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (cell.vertices[f] == vertex) continue;
      const std::uint32_t next = cell_of(cell.neighbors[f]);
      if (seen_[next] == search_) continue;
      seen_[next] = search_;
      cells_.push_back(next);
    }
  }
  return cells_;
}

// Walks towards b within the star of a. The walk ends, as any walk towards a point in a Delaunay tetrahedralization; in
// the cell at a that b is above, and if ab is an edge, then it is one of that cell.
bool CellStar::has_edge(std::uint32_t a, std::uint32_t b) {
  std::uint32_t here = d_.vertices[a].cell;
  // Never outside of the hull: b is not.
  if (d_.is_ghost(here)) here = cell_of(d_.cells[here].neighbors[3]);
  const Point3& p = d_.point(b);
  for (std::uint32_t from = no_neighbor;;) {
    const Cell& cell = d_.cells[here];
    if (place_of(cell, b) < 4) return true;
    std::uint32_t exit = 4;
    for (std::uint32_t f = 0; f < 4 && exit == 4; ++f) {
      if (cell.vertices[f] == a || cell.neighbors[f] == from) continue;
      const auto& corner = face_corners[f];
      if (numbers::orient3d(d_.point(cell.vertices[corner[0]]), d_.point(cell.vertices[corner[1]]),
                            d_.point(cell.vertices[corner[2]]), p) < 0)
        exit = f;
    }
    if (exit == 4) return false;
    from = face_code(here, exit);
    here = cell_of(cell.neighbors[exit]);
  }
}

std::uint32_t CellStar::find_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  for (const std::uint32_t here : around(a)) {
    const Cell& cell = d_.cells[here];
    const std::uint32_t i = place_of(cell, a), j = place_of(cell, b), k = place_of(cell, c);
    if (j == 4 || k == 4) continue;
    const std::uint32_t f = 6 - i - j - k;
    const auto& corner = face_corners[f];
    const bool above =
        (corner[0] == i && corner[1] == j) || (corner[1] == i && corner[2] == j) || (corner[2] == i && corner[0] == j);
    return above ? face_code(here, f) : cell.neighbors[f];
  }
  return no_neighbor;
}

}  // namespace ccdt::delaunay
