#include "engine/improve/vertex_star.h"

namespace ccdt {

void gather_cells(CellComplex& x, std::uint32_t vertex, std::vector<std::uint32_t>& cells) {
  cells.clear();
  const std::uint32_t question = ++x.questions;
  const std::uint32_t first = x.cell_of_vertex[vertex];
  x.marks[first] = question;
  cells.push_back(first);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = x.cells[cells[i]];
    for (std::uint32_t f = 0; f < 4; ++f) {
      const std::uint32_t beyond = cell.neighbors[f];
      if (cell.vertices[f] == vertex || beyond == no_neighbor || x.marks[cell_of(beyond)] == question) continue;
      x.marks[cell_of(beyond)] = question;
      cells.push_back(cell_of(beyond));
    }
  }
}

void gather_star(CellComplex& x, std::uint32_t vertex, VertexStar& star) {
  gather_cells(x, vertex, star.cells);
  star.faces.clear();
  for (const std::uint32_t c : star.cells) {
    const auto& v = x.cells[c].vertices;
    const auto& corner = face_corners[x.place(c, vertex)];
    star.faces.push_back({x.points[v[corner[0]]], x.points[v[corner[1]]], x.points[v[corner[2]]]});
  }
}

}  // namespace ccdt
