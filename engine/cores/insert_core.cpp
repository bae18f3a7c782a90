#include <array>
#include <atomic>
#include <stdexcept>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/platform.h"
#include "engine/base/simplex_map.h"
#include "engine/cores/lattice_core.h"
#include "engine/delaunay/insert_vertices.h"

namespace ccdt::cores {
namespace {

using delaunay::cell_of;
using delaunay::corners_of_face;
using delaunay::Delaunay;
using delaunay::face_code;
using delaunay::face_of;
using delaunay::no_neighbor;

class Joiner {
 public:
  Joiner(Delaunay& d, std::uint32_t outer_cells, const std::vector<std::uint32_t>& border)
      : d_(d), outer_cells_(outer_cells), border_(border), walls_(outer_cells, 0), on_border_(d.vertices.size(), 0) {
    std::vector<std::array<std::uint32_t, 3>> faces(border.size());
    parallel_for(border.size(), 4096, [&](std::size_t i) {
      faces[i] = corners(border[i]);
      for (const std::uint32_t v : faces[i]) as_atomic(on_border_[v]).store(1, std::memory_order_relaxed);
    });
    faces_ = FaceMap(faces, d.vertices.size());
  }

  void run() {
    std::atomic<std::size_t> outside = 0;
    std::vector<std::uint32_t> inside = parallel_collect<std::uint32_t>(
        outer_cells_, 1 << 14, [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& found) {
          std::size_t joined = 0;
          for (auto c = static_cast<std::uint32_t>(begin); c < end; ++c)
            if (!d_.is_dead(c)) joined += find_border(c, found);
          outside += joined;
        });
    if (outside != border_.size() || inside.empty() != border_.empty())
      throw std::logic_error("the core of the lattice does not fit into the tetrahedralization around it");
    spread(inside);
    parallel_for(inside.size(), 4096, [&](std::size_t i) { d_.cells[inside[i]].neighbors[0] = no_neighbor; });
    d_.free_cells.insert(d_.free_cells.end(), inside.begin(), inside.end());
    work_done.cells_destroyed += inside.size();
  }

 private:
  static constexpr std::uint8_t removed = 0x10;

  std::array<std::uint32_t, 3> corners(std::uint32_t code) const {
    return corners_of_face(d_.cells[cell_of(code)].vertices, face_of(code));
  }
  bool is_on_border(std::uint32_t v) const { return v != delaunay::ghost_vertex && on_border_[v] != 0; }

  /// Joins the faces of a cell that are on the border, and adds the cell to `inside` if it is within the border.
  /// \return  how many faces were joined
  std::size_t find_border(std::uint32_t c, std::vector<std::uint32_t>& inside) {
    const auto& v = d_.cells[c].vertices;
    const int others = !is_on_border(v[0]) + !is_on_border(v[1]) + !is_on_border(v[2]) + !is_on_border(v[3]);
    if (others > 1) return 0;
    std::size_t joined = 0;
    bool is_inside = false;
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (others == 1 && is_on_border(v[f])) continue;
      const auto face = corners_of_face(v, f);
      const auto [number, is_opposite] = faces_.find(face[0], face[1], face[2]);
      if (number == none) continue;
      walls_[c] |= static_cast<std::uint8_t>(1u << f);
      if (is_opposite) {
        delaunay::join_faces(d_.cells, face_code(c, f), border_[number]);
        ++joined;
      } else {
        is_inside = true;
      }
    }
    if (is_inside) {
      walls_[c] |= removed;
      inside.push_back(c);
    }
    return joined;
  }

  /// Adds all cells that are reached from the first ones without crossing the border, step by step.
  void spread(std::vector<std::uint32_t>& inside) {
    for (std::size_t done = 0; done < inside.size();) {
      const std::vector<std::uint32_t> reached = parallel_collect<std::uint32_t>(
          inside.size() - done, 1024, [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& found) {
            for (std::size_t i = begin; i < end; ++i) remove_neighbors(inside[done + i], found);
          });
      done = inside.size();
      inside.insert(inside.end(), reached.begin(), reached.end());
    }
  }

  /// Several threads may reach the same neighbor; only one of them gets it.
  void remove_neighbors(std::uint32_t c, std::vector<std::uint32_t>& found) {
    const std::uint8_t walls = as_atomic(walls_[c]).load(std::memory_order_relaxed);
    for (std::uint32_t f = 0; f < 4; ++f) {
      if ((walls >> f & 1) != 0) continue;
      const std::uint32_t next = cell_of(d_.cells[c].neighbors[f]);
      if ((set_bits_(walls_[next], removed) & removed) == 0) found.push_back(next);
    }
  }

  Delaunay& d_;
  const std::uint32_t outer_cells_;
  const std::vector<std::uint32_t>& border_;  ///< codes of faces
  std::vector<std::uint8_t> walls_;           ///< by cell: which faces are on the border; must it be removed?
  std::vector<std::uint8_t> on_border_;       ///< by vertex
  FaceMap faces_;                             ///< of the border
  const SetBits set_bits_;
};

/// Puts the core into the tetrahedralization of the other vertices. A flood fill from the core's border removes the old
/// cells within the core; the cells outside become neighbors of the core's cells.
///
/// \param d  the Delaunay tetrahedralization of at least all vertices that are not deep; its list of vertices has all
void insert_core(const LatticeCore& core, Delaunay& d) {
  if (core.cell_count == 0) return;
  const auto first = static_cast<std::uint32_t>(d.cells.size());
  d.cells.resize(d.cells.size() + core.cell_count);
  const std::vector<std::uint32_t> border = make_core_cells(core, d, first);
  Joiner(d, first, border).run();
  work_done.cells_created += core.cell_count;
  note_bytes(bytes_of(d.vertices, d.cell_at, d.cells, d.free_cells, core.sites.blocks, border));
}

/// One of this many vertices may be inserted although it is deep.
constexpr std::uint32_t extra_vertices = 1024;

/// The vertices to insert, in order. Without deep vertices, some cells would be as large as the core, and reach into
/// the parts of space of several threads. A few of the first vertices, which are everywhere, keep cells small.
std::vector<std::uint32_t> vertices_to_insert(const LatticeCore& core, std::uint32_t first) {
  const std::size_t count = core.is_deep.size(), extra = thread_count() == 1 ? 0 : (count - first) / extra_vertices;
  return parallel_select(count, 1 << 14,
                         [&](std::size_t v) { return v >= first && (v < first + extra || core.is_deep[v] == 0); });
}

}  // namespace

std::size_t insert_points(const lattice::LatticePoints& lattice, Delaunay& d, const Progress& progress) {
  std::vector<Point3> others;
  others.reserve(d.vertices.size());
  for (const delaunay::DelaunayVertex& v : d.vertices) others.push_back(v.point);
  const auto first = static_cast<std::uint32_t>(d.vertices.size());
  const std::vector<std::uint32_t> order = append_vertices(d, lattice.points, lattice.later_rounds);
  RawVector<std::uint32_t> vertex(order.size());
  parallel_for(order.size(), 4096, [&](std::size_t i) { vertex[order[i]] = first + static_cast<std::uint32_t>(i); });

  const LatticeCore core = find_lattice_core(lattice, vertex, others, d.vertices.size());
  const std::vector<std::uint32_t> inserted = vertices_to_insert(core, first);
  reserve_cells(d, d.cells.size() + delaunay::most_new_cells(inserted.size()) + core.cell_count);
  insert_vertices(d, inserted, progress);
  insert_core(core, d);
  return core.cell_count;
}

}  // namespace ccdt::cores
