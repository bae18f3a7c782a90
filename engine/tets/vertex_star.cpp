#include "engine/tets/vertex_star.h"

namespace ccdt::tets {

void gather_cells(const CellComplex& x, std::uint32_t vertex, CellMarks& marks, std::vector<std::uint32_t>& cells) {
  cells.clear();
  marks.clear(x.cell_count());
  const std::uint32_t first = x.cell_at(vertex);
  marks.mark(first);
  cells.push_back(first);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = x.cell(cells[i]);
    for (std::uint32_t f = 0; f < 4; ++f) {
      const std::uint32_t next = cell.neighbors[f];
      if (cell.vertices[f] == vertex || next == no_neighbor || marks.is_marked(cell_of(next))) continue;
      marks.mark(cell_of(next));
      cells.push_back(cell_of(next));
    }
  }
}

void gather_star(const CellComplex& x, std::uint32_t vertex, CellMarks& marks, VertexStar& star) {
  gather_cells(x, vertex, marks, star.cells);
  star.faces.clear();
  for (const std::uint32_t c : star.cells) {
    const auto [a, b, d] = corners_of_face(x.cell(c).vertices, x.place(c, vertex));
    star.faces.push_back({x.point(a), x.point(b), x.point(d)});
  }
}

}  // namespace ccdt::tets
