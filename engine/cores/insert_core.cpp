#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/simplex_map.h"
#include "engine/cores/lattice_core.h"
#include "engine/delaunay/insert_vertices.h"

namespace ccdt::cores {
namespace {

using delaunay::Cell;
using delaunay::cell_of;
using delaunay::corners_of_face;
using delaunay::Delaunay;
using delaunay::face_code;
using delaunay::face_of;
using delaunay::no_neighbor;

/// Do the corners of one triangle have the same cyclic order?
bool same_direction(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
  return a == b || (a[0] == b[1] && a[1] == b[2] && a[2] == b[0]) || (a[0] == b[2] && a[1] == b[0] && a[2] == b[1]);
}

class Joiner {
 public:
  Joiner(Delaunay& d, std::uint32_t outer_cells, const std::vector<std::uint32_t>& border)
      : d_(d), outer_cells_(outer_cells), walls_(outer_cells, 0), on_border_(d.vertices.size(), false) {
    faces_.reserve(border.size());
    for (const std::uint32_t code : border) {
      const auto [a, b, c] = corners(code);
      faces_.insert(face_key(a, b, c), code);
      on_border_[a] = on_border_[b] = on_border_[c] = true;
    }
  }

  void run() {
    const std::size_t runs = thread_count();
    std::vector<std::vector<std::uint32_t>> inside(runs);
    std::vector<std::size_t> outside(runs, 0);
    parallel_for(runs, 1, [&](std::size_t run) {
      const auto begin = static_cast<std::uint32_t>(outer_cells_ * run / runs),
                 end = static_cast<std::uint32_t>(outer_cells_ * (run + 1) / runs);
      for (std::uint32_t c = begin; c < end; ++c)
        if (!d_.is_dead(c)) outside[run] += find_border(c, inside[run]);
    });
    for (const auto& some : inside) inside_.insert(inside_.end(), some.begin(), some.end());
    if (std::reduce(outside.begin(), outside.end()) != faces_.size() || inside_.empty() != faces_.empty())
      throw std::logic_error("the core of the lattice does not fit into the tetrahedralization around it");
    for (std::size_t i = 0; i < inside_.size(); ++i) spread(inside_[i]);
    for (const std::uint32_t c : inside_) {
      d_.cells[c].neighbors[0] = no_neighbor;
      d_.free_cells.push_back(c);
    }
    work_done.cells_destroyed += inside_.size();
  }

 private:
  static constexpr std::uint8_t removed = 0x10;

  std::array<std::uint32_t, 3> corners(std::uint32_t code) const {
    return corners_of_face(d_.cells[cell_of(code)].vertices, face_of(code));
  }
  bool is_on_border(std::uint32_t v) const { return v != delaunay::ghost_vertex && on_border_[v]; }

  /// Joins the faces of a cell that are on the border. If the cell is within it, notes that.
  /// \return  how many faces were joined
  std::size_t find_border(std::uint32_t c, std::vector<std::uint32_t>& inside) {
    const auto& v = d_.cells[c].vertices;
    const int others = !is_on_border(v[0]) + !is_on_border(v[1]) + !is_on_border(v[2]) + !is_on_border(v[3]);
    if (others > 1) return 0;
    std::size_t joined = 0;
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (others == 1 && is_on_border(v[f])) continue;
      const auto face = corners_of_face(v, f);
      const std::uint32_t* code = faces_.find(face_key(face[0], face[1], face[2]));
      if (code == nullptr) continue;
      walls_[c] |= static_cast<std::uint8_t>(1u << f);
      if (same_direction(face, corners(*code))) {
        remove(c, inside);
      } else {
        delaunay::join_faces(d_.cells, face_code(c, f), *code);
        ++joined;
      }
    }
    return joined;
  }

  void remove(std::uint32_t c, std::vector<std::uint32_t>& inside) {
    if ((walls_[c] & removed) != 0) return;
    walls_[c] |= removed;
    inside.push_back(c);
  }

  void spread(std::uint32_t c) {
    for (std::uint32_t f = 0; f < 4; ++f)
      if ((walls_[c] >> f & 1) == 0) remove(cell_of(d_.cells[c].neighbors[f]), inside_);
  }

  Delaunay& d_;
  const std::uint32_t outer_cells_;
  std::vector<std::uint8_t> walls_;  ///< by cell: faces on the border; must it be removed?
  std::vector<bool> on_border_;      ///< by vertex
  HashTable<FaceKey, std::uint32_t> faces_;
  std::vector<std::uint32_t> inside_;
};

/// Puts the core into the tetrahedralization of the other vertices. A flood fill from the core's border removes the old
/// cells within the core; the cells outside become neighbors of those of the core.
///
/// \param d  the Delaunay tetrahedralization of at least all vertices that are not deep; its list of vertices has all
void insert_core(const LatticeCore& core, Delaunay& d) {
  if (core.cell_count == 0) return;
  const auto first = static_cast<std::uint32_t>(d.cells.size());
  d.cells.resize(d.cells.size() + core.cell_count);
  const std::span<Cell> cells = std::span(d.cells).subspan(first);
  const std::vector<std::uint32_t> border = make_core_cells(core, cells, first);
  Joiner(d, first, border).run();
  // All vertices of the removed cells belong to the core.
  for (std::uint32_t c = first; c < d.cells.size(); ++c)
    for (const std::uint32_t v : d.cells[c].vertices) d.vertices[v].cell = c;
  work_done.cells_created += core.cell_count;
  note_bytes(bytes_of(d.vertices, d.cells, d.free_cells, core.sites.blocks, border));
}

}  // namespace

std::size_t insert_points(const lattice::LatticePoints& lattice, Delaunay& d, const Progress& progress) {
  std::vector<Point3> others;
  others.reserve(d.vertices.size());
  for (const delaunay::DelaunayVertex& v : d.vertices) others.push_back(v.point);
  const auto first = static_cast<std::uint32_t>(d.vertices.size());
  const std::vector<std::uint32_t> order = append_vertices(d, lattice.points);
  std::vector<std::uint32_t> vertex(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) vertex[order[i]] = first + i;

  const LatticeCore core = find_lattice_core(lattice, vertex, others, d.vertices.size());
  std::vector<std::uint32_t> not_deep;
  for (std::uint32_t v = first; v < d.vertices.size(); ++v)
    if (!core.is_deep[v]) not_deep.push_back(v);
  insert_vertices(d, not_deep, progress);
  insert_core(core, d);
  return core.cell_count;
}

}  // namespace ccdt::cores
