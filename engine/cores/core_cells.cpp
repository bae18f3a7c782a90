#include <array>
#include <atomic>

#include "engine/base/parallel.h"
#include "engine/base/platform.h"
#include "engine/cores/lattice_core.h"
#include "engine/cores/split_by_rank.h"

namespace ccdt::cores {
namespace {

using delaunay::Cell;
using delaunay::Delaunay;
using delaunay::face_code;
using delaunay::no_neighbor;

using Numbers = Surrounded<std::uint32_t>;
using Kinds = Surrounded<std::uint8_t>;

/// The corners of a unit cube with even coordinate sum, and those with odd sum, positively oriented.
constexpr std::array<std::array<std::uint8_t, 4>, 2> tetrahedron_corners = {{{0, 5, 3, 6}, {1, 2, 4, 7}}};

/// The position of each corner in its tetrahedron.
constexpr std::array<std::uint8_t, 8> place_of_corner = {0, 0, 1, 2, 2, 1, 3, 3};

class CellMaker {
 public:
  /// \param border  gets codes of faces
  CellMaker(const SiteBlocks& sites, Delaunay& d, std::uint32_t first, std::vector<std::uint32_t>& border)
      : sites_(sites), d_(d), cells_(d.cells.data() + first), first_(first), border_(border) {}

  void make_cells_of(const SiteBlock& block) {
    if (block.cell_count == 0) return;
    point_.gather(sites_, block, &SiteBlock::point, none);
    cube_.gather(sites_, block, &SiteBlock::cube, none);
    kind_.gather(sites_, block, &SiteBlock::kind, 0);
    for_each_place([&](std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t i, int at) {
      const Place p = {x, y, z};
      if (has_shape_at(sites_.kind, p) && block.point[i] != none) {
        if (sites_.kind == Lattice::fcc)
          make_octahedron(at, block.point[i], block.kind[i]);
        else
          make_tetrahedra_at_face(at, block.point[i], even_axis(p));
      }
      if (block.cube[i] == none) return;
      if (sites_.kind == Lattice::fcc)
        make_tetrahedron(at, block.cube[i], (x + y + z) & 1);
      else
        make_cube(at, block.cube[i], split_of_kind(block.kind[i]));
    });
    note_last_cells(block);
  }

 private:
  /// From the last cell backward, so that most vertices change once. Several blocks have cells of the same vertex.
  void note_last_cells(const SiteBlock& block) {
    for (std::uint32_t cell = block.first_cell + block.cell_count; cell-- > block.first_cell;)
      for (const std::uint32_t v : cells_[cell].vertices) {
        const std::uint32_t number = first_ + cell;
        const auto last = as_atomic(d_.cell_at[v]);
        std::uint32_t before = last.load(std::memory_order_relaxed);
        while ((before == none || before < number) &&
               !last.compare_exchange_weak(before, number, std::memory_order_relaxed)) {
        }
      }
  }

  /// Joins face f of a cell to the face of another core cell with this code, or to nothing if it is `none`.
  void join(std::uint32_t cell, std::uint32_t f, std::uint32_t code) {
    if (code == none) {
      border_.push_back(face_code(first_ + cell, f));
      cells_[cell].neighbors[f] = no_neighbor;
    } else {
      cells_[cell].neighbors[f] = 4 * first_ + code;
    }
  }
  static std::uint32_t code_in(std::uint32_t base, std::uint32_t cell, std::uint32_t f) {
    return base == none ? none : face_code(base + cell, f);
  }

  // ---- Face-centered: tetrahedra and octahedra; each meets only the other kind

  /// An octahedron is split around the diagonal d into the cells q = 0 .. 3. Bit 0: is the cell on the upper side of
  /// the next axis? Bit 1: and of the axis after that? A cell has the lower end of the diagonal, its upper end, and the
  /// ends of those two axes, in this order if both are on the same side, otherwise in the opposite order.
  void make_octahedron(int at, std::uint32_t base, unsigned d) {
    const int axis[] = {stride[d], stride[(d + 1) % 3], stride[(d + 2) % 3]};
    for (unsigned q = 0; q < 4; ++q) {
      const bool plus1 = (q & 1) != 0, plus2 = (q & 2) != 0;
      const unsigned place1 = place_of_next(q), place2 = 5 - place1;
      Cell& cell = cells_[base + q];
      cell.vertices[0] = point_[at - axis[0]];
      cell.vertices[1] = point_[at + axis[0]];
      cell.vertices[place1] = point_[plus1 ? at + axis[1] : at - axis[1]];
      cell.vertices[place2] = point_[plus2 ? at + axis[2] : at - axis[2]];
      join(base + q, place1, face_code(base + (q ^ 1), place_of_next(q ^ 1)));
      join(base + q, place2, face_code(base + (q ^ 2), 5 - place_of_next(q ^ 2)));
      for (unsigned f = 0; f < 2; ++f) {
        // The face opposite the lower end is on the upper side.
        const unsigned corner = (1 - f) << d | (q & 1) << (d + 1) % 3 | (q >> 1) << (d + 2) % 3;
        join(base + q, f, code_in(cube_[at + corner_offset(corner) - corner_offset(7)], 0, place_of_corner[corner]));
      }
    }
  }
  /// The vertex on the axis next to the diagonal.
  static unsigned place_of_next(unsigned q) { return q == 0 || q == 3 ? 2 : 3; }

  /// The face opposite a corner belongs to the octahedron around the corner across from it.
  void make_tetrahedron(int at, std::uint32_t number, unsigned odd) {
    for (std::uint32_t f = 0; f < 4; ++f) {
      const unsigned corner = tetrahedron_corners[odd][f];
      cells_[number].vertices[f] = point_[at + corner_offset(corner)];
      const int center = at + corner_offset(7 - corner);
      const unsigned d = kind_[center], q = (corner >> (d + 1) % 3 & 1) | (corner >> (d + 2) % 3 & 1) << 1;
      join(number, f, code_in(point_[center], q, 1 - (corner >> d & 1)));
    }
  }

  // ---- Body-centered

  /// The cells r = 0 .. 3 around a face are at its sides, counterclockwise around the axis k: at the upper side of the
  /// next axis, at that of the axis after it, then at the lower sides. A cell has the lower end of the axis, the upper
  /// end and the ends of its side.
  void make_tetrahedra_at_face(int at, std::uint32_t base, int k) {
    const int up = stride[k];
    for (unsigned r = 0; r < 4; ++r) {
      Cell& cell = cells_[base + r];
      cell.vertices = {point_[at - up], point_[at + up], point_[at + side(k, r) + side(k, (r + 3) % 4)],
                       point_[at + side(k, r) + side(k, (r + 1) % 4)]};
      join(base + r, 2, face_code(base + (r + 1) % 4, 3));
      join(base + r, 3, face_code(base + (r + 3) % 4, 2));
      // The neighbor is at the same edge, in the cube whose center is the end of the axis. There, the other face is on
      // this side's axis, and the edge is on the side of this face.
      const int other_axis = (k + 1 + static_cast<int>(r & 1)) % 3;
      const bool is_upper = r < 2;
      for (unsigned f = 0; f < 2; ++f) {
        const bool from_upper_end = f == 0;  // the face opposite the lower end
        const int other = at + side(k, r) + (from_upper_end ? up : -up);
        const unsigned other_side = ((k - other_axis + 3) % 3 == 1 ? 0u : 1u) + (from_upper_end ? 2u : 0u);
        join(base + r, f, code_in(point_[other], other_side, is_upper ? 1 : 0));
      }
    }
  }
  static int side(int k, unsigned r) {
    const int s = stride[(k + 1 + static_cast<int>(r & 1)) % 3];
    return r < 2 ? s : -s;
  }

  // ---- Simple cubic

  void make_cube(int at, std::uint32_t base, const CubeSplit& split) {
    for (std::uint32_t c = 0; c < split.count; ++c) {
      for (std::uint32_t f = 0; f < 4; ++f) {
        cells_[base + c].vertices[f] = point_[at + corner_offset(split.cells[c][f])];
        const std::uint8_t code = split.neighbors[4 * c + f];
        join(base + c, f, code == CubeSplit::outer_face ? code_in_next_cube(at, split.cells[c], f) : 4 * base + code);
      }
    }
  }

  std::uint32_t code_in_next_cube(int at, const std::array<std::uint8_t, 4>& cell, std::uint32_t f) const {
    const auto corners = delaunay::corners_of_face({cell[0], cell[1], cell[2], cell[3]}, f);
    const unsigned all = corners[0] & corners[1] & corners[2], any = corners[0] | corners[1] | corners[2];
    // All on the upper side of one axis, or all on the lower side.
    const unsigned axis = all != 0 ? all : 7 & ~any;
    const int next = all != 0 ? at + corner_offset(axis) : at - corner_offset(axis);
    if (cube_[next] == none) return none;
    unsigned mask = 0;
    for (const std::uint32_t v : corners) mask |= 1u << (v ^ axis);
    return 4 * cube_[next] + split_of_kind(kind_[next]).outer[mask];
  }

  const SiteBlocks& sites_;
  Delaunay& d_;
  Cell* const cells_;  ///< of the core
  const std::uint32_t first_;
  std::vector<std::uint32_t>& border_;
  Numbers point_, cube_;
  Kinds kind_;
};

}  // namespace

std::vector<std::uint32_t> make_core_cells(const LatticeCore& core, Delaunay& d, std::uint32_t first) {
  constexpr std::size_t grain = 16;
  const auto& blocks = core.sites.blocks;
  return parallel_collect<std::uint32_t>(blocks.size(), grain,
                                         [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& border) {
                                           CellMaker maker(core.sites, d, first, border);
                                           for (std::size_t b = begin; b < end; ++b) maker.make_cells_of(blocks[b]);
                                         });
}

}  // namespace ccdt::cores
