#include "engine/delaunay/wrap_delaunay.h"

#include <algorithm>

#include "engine/delaunay/first_face.h"
#include "engine/delaunay/fourth_vertex.h"
#include "engine/delaunay/open_faces.h"
#include "engine/delaunay/open_hull.h"
#include "engine/delaunay/vertex_grid.h"

namespace ccdt {
namespace {

/// The construction. Until it is done, cells name vertices by their places in the grid's order, and the open faces of a
/// cell have no neighbor.
class Wrap {
 public:
  Wrap(const VertexGrid& grid, const Progress& progress) : grid_(grid), search_(grid), progress_(progress) {
    cells_.reserve(7 * grid.vertices.size() + 64);
  }

  /// \param hull_face  the outside above it
  std::vector<Cell> run(const std::array<std::uint32_t, 3>& hull_face) {
    const std::array<std::uint32_t, 3> inward = {hull_face[0], hull_face[2], hull_face[1]};
    add_cell(inward, search_.find(inward, ghost_vertex, Reach::everywhere));
    advance();
    for (auto rest = unfinished(); !rest.empty(); rest = unfinished()) {
      for (const Unfinished& u : rest)
        if (is_open(u.face)) add_cell_at(u.face, u.candidate, Reach::everywhere);
      advance();
    }
    add_ghosts(cells_, postponed_);
    return std::move(cells_);
  }

 private:
  bool is_open(std::uint32_t code) const { return cells_[cell_of(code)].neighbors[face_of(code)] == no_neighbor; }

  /// Adds the cell over each open face for which a search nearby finds one; postpones the others.
  void advance() {
    std::vector<std::uint32_t> faces;
    while (!front_.empty()) {
      faces.swap(front_);
      for (const std::uint32_t code : faces)
        if (is_open(code) && !add_cell_at(code, ghost_vertex, Reach::near)) postponed_.push_back(code);
      faces.clear();
    }
  }

  std::vector<Unfinished> unfinished() {
    std::erase_if(postponed_, [&](std::uint32_t code) { return !is_open(code); });
    return find_unfinished(cells_, grid_.vertices, postponed_);
  }

  bool add_cell_at(std::uint32_t code, std::uint32_t candidate, Reach reach) {
    const auto face = outward_corners(cells_, code);
    const std::uint32_t apex = search_.find(face, candidate, reach);
    if (apex == ghost_vertex) return false;
    add_cell(face, apex);
    return true;
  }

  /// Adds the cell with the apex above the face.
  void add_cell(const std::array<std::uint32_t, 3>& face, std::uint32_t apex) {
    const auto cell = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back({{face[0], face[1], face[2], apex}, {no_neighbor, no_neighbor, no_neighbor, no_neighbor}});
    for (std::uint32_t f = 4; f-- > 0;)
      if (!open_.close_or_open(cells_, face_code(cell, f))) front_.push_back(face_code(cell, f));
    if ((cell & 0x3FFFF) == 0x3FFFF) report(progress_, "delaunay", cell, 0);
  }

  const VertexGrid& grid_;
  FourthVertexSearch search_;
  const Progress& progress_;
  std::vector<Cell> cells_;
  OpenFaces open_;
  std::vector<std::uint32_t> front_;      ///< faces to look at next; some have been closed since
  std::vector<std::uint32_t> postponed_;  ///< open faces without a vertex nearby: of the hull, or at a wide gap
};

}  // namespace

Delaunay wrap_delaunay(std::vector<DelaunayVertex> vertices, double grid_scale, const Progress& progress) {
  const VertexGrid grid = make_vertex_grid(vertices, grid_scale);
  const auto hull_face = find_first_face(grid.vertices);
  if (!hull_face) refuse_flat_points();
  Delaunay d;
  d.vertices = std::move(vertices);
  d.cells = Wrap(grid, progress).run(*hull_face);
  for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
    for (std::uint32_t& v : d.cells[c].vertices) {
      if (v == ghost_vertex) continue;
      v = grid.vertices[v].id;
      d.vertices[v].cell = c;
    }
  }
  return d;
}

}  // namespace ccdt
