#include "engine/cores/lattice_core.h"

#include <algorithm>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/cores/split_by_rank.h"

namespace ccdt::cores {
namespace {

using Flags = Surrounded<std::uint8_t>;
using Numbers = Surrounded<std::uint32_t>;

/// Calls visit(index) for the vertices of the shape around a place, until it returns false.
/// \return  did it return true for all?
template <class Visit>
bool for_vertices_at(Lattice kind, const Place& p, int at, const Visit& visit) {
  if (kind == Lattice::fcc) {
    for (const int s : stride)
      if (!visit(at - s) || !visit(at + s)) return false;
    return true;
  }
  const int k = even_axis(p), a = stride[(k + 1) % 3], b = stride[(k + 2) % 3];
  return visit(at - stride[k]) && visit(at + stride[k]) && visit(at - a - b) && visit(at - a + b) &&
         visit(at + a - b) && visit(at + a + b);
}

/// The same for the shape in a unit cube.
template <class Visit>
bool for_vertices_of_cube(Lattice kind, const Place& p, int at, const Visit& visit) {
  const unsigned odd = (p[0] + p[1] + p[2]) & 1;
  for (unsigned corner = 0; corner < 8; ++corner) {
    if (kind == Lattice::fcc && ((corner ^ corner >> 1 ^ corner >> 2) & 1) != odd) continue;
    if (!visit(at + corner_offset(corner))) return false;
  }
  return true;
}

/// How many blocks one thread takes at a time.
constexpr std::size_t grain = 16;

/// Finds the core in a part of the blocks.
class CoreFinder {
 public:
  CoreFinder(SiteBlocks& sites, std::vector<std::uint8_t>& is_deep)
      : sites_(sites), kind_(sites.kind), is_deep_(is_deep) {}

  /// Finds the shapes with all their vertices, and how they are split.
  void find_whole_shapes(SiteBlock& block) {
    around_.gather(sites_, block, &SiteBlock::flags, 0);
    vertex_.gather(sites_, block, &SiteBlock::point, none);
    const auto is_present = [&](int i) { return (around_[i] & present) != 0; };
    for_each_place([&](std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t i, int at) {
      const Place p = {x, y, z};
      std::uint8_t shapes = 0;
      if (has_shape_at(kind_, p) && for_vertices_at(kind_, p, at, is_present)) {
        shapes |= core_point;
        if (kind_ == Lattice::fcc) block.kind[i] = static_cast<std::uint8_t>(diagonal_at(at));
      }
      if (has_cubes(kind_) && for_vertices_of_cube(kind_, p, at, is_present)) {
        shapes |= core_cube;
        if (kind_ == Lattice::sc) block.kind[i] = kind_of_cube(corners_of_cube(at));
      }
      block.shapes[i] = shapes;
      if (shapes != 0) block.has_core = true;
    });
  }

  void find_deep_vertices(SiteBlock& block) {
    around_.gather(sites_, block, &SiteBlock::shapes, 0);
    for_each_place([&](std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t i, int at) {
      if ((block.flags[i] & present) == 0 || !is_deep({x, y, z}, at)) return;
      block.flags[i] |= deep;
      is_deep_[block.point[i]] = 1;
    });
  }

  /// Numbers the cells of core shapes with a deep vertex, from `first` on.
  void number_cells(SiteBlock& block, std::uint32_t first) {
    around_.gather(sites_, block, &SiteBlock::flags, 0);
    const auto is_not_deep = [&](int i) { return (around_[i] & deep) == 0; };
    std::uint32_t next = first;
    for_each_place([&](std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t i, int at) {
      const Place p = {x, y, z};
      if ((block.shapes[i] & core_point) != 0 && !for_vertices_at(kind_, p, at, is_not_deep)) {
        block.point[i] = next;
        next += 4;
      }
      if ((block.shapes[i] & core_cube) != 0 && !for_vertices_of_cube(kind_, p, at, is_not_deep)) {
        block.cube[i] = next;
        next += kind_ == Lattice::fcc ? 1 : split_of_kind(block.kind[i]).count;
      }
    });
    block.first_cell = first, block.cell_count = next - first;
  }

 private:
  /// Are all shapes of a site core?
  bool is_deep(const Place& p, int at) const {
    const auto is_core_point = [&](int i) { return (around_[i] & core_point) != 0; };
    if (has_cubes(kind_)) {
      for (unsigned corner = 0; corner < 8; ++corner)
        if ((around_[at - corner_offset(corner)] & core_cube) == 0) return false;
      if (kind_ == Lattice::sc) return true;
    }
    for (const int s : stride)
      if (kind_ != Lattice::sc && has_faces_beside(p) && (!is_core_point(at - s) || !is_core_point(at + s)))
        return false;
    if (kind_ == Lattice::fcc || is_odd(p)) return true;
    for (int k = 0; k < 3; ++k) {
      const int a = stride[k], b = stride[(k + 1) % 3];
      if (!is_core_point(at - a - b) || !is_core_point(at - a + b) || !is_core_point(at + a - b) ||
          !is_core_point(at + a + b))
        return false;
    }
    return true;
  }
  bool is_odd(const Place& p) const { return (p[0] & 1) != 0; }
  bool has_faces_beside(const Place& p) const { return kind_ == Lattice::fcc || is_odd(p); }

  /// The axis that the octahedron at a place is split around.
  int diagonal_at(int at) const {
    std::array<std::uint32_t, 6> ends{};
    for (std::size_t k = 0; k < 3; ++k)
      ends[2 * k] = vertex_[at - stride[k]], ends[2 * k + 1] = vertex_[at + stride[k]];
    return diagonal_of_octahedron(ends.data());
  }

  std::array<std::uint32_t, 8> corners_of_cube(int at) const {
    std::array<std::uint32_t, 8> corners{};
    for (unsigned c = 0; c < 8; ++c) corners[c] = vertex_[at + corner_offset(c)];
    return corners;
  }

  SiteBlocks& sites_;
  const Lattice kind_;
  std::vector<std::uint8_t>& is_deep_;
  Flags around_;
  Numbers vertex_;
};

/// Calls visit(finder, block) for all blocks, on several threads.
template <class Visit>
void for_blocks(SiteBlocks& sites, std::vector<std::uint8_t>& is_deep, const Visit& visit) {
  parallel_ranges(sites.blocks.size(), grain, [&](std::size_t begin, std::size_t end) {
    CoreFinder finder(sites, is_deep);
    for (std::size_t b = begin; b < end; ++b) visit(finder, sites.blocks[b]);
  });
}

void move_numbers(SiteBlock& block, std::uint32_t by) {
  block.first_cell += by;
  if (block.cell_count == 0) return;
  for (std::size_t i = 0; i < SiteBlock::size; ++i) {
    if ((block.shapes[i] & core_point) != 0 && block.point[i] != none) block.point[i] += by;
    if (block.cube[i] != none) block.cube[i] += by;
  }
}

/// Numbers the cells of all core shapes with a deep vertex: first within each chunk of blocks, then with the offset of
/// the chunks before it.
/// \return  how many there are
std::uint32_t number_cells(SiteBlocks& sites, std::vector<std::uint8_t>& is_deep) {
  auto& blocks = sites.blocks;
  const std::size_t length = thread_count() == 1 ? blocks.size() + 1 : grain;
  std::vector<std::uint32_t> firsts = parallel_chunks(blocks.size(), length, [&](std::size_t begin, std::size_t end) {
    CoreFinder finder(sites, is_deep);
    std::uint32_t next = 0;
    for (std::size_t b = begin; b < end; ++b) {
      finder.number_cells(blocks[b], next);
      next += blocks[b].cell_count;
    }
    return next;
  });
  std::uint32_t count = 0;
  for (std::uint32_t& first : firsts) count += std::exchange(first, count);
  parallel_for(firsts.size(), 1, [&](std::size_t chunk) {
    if (firsts[chunk] == 0) return;
    for (std::size_t b = chunk * length; b < std::min(blocks.size(), (chunk + 1) * length); ++b)
      move_numbers(blocks[b], firsts[chunk]);
  });
  return count;
}

}  // namespace

LatticeCore find_lattice_core(const lattice::LatticePoints& lattice, std::span<const std::uint32_t> vertex,
                              std::span<const Point3> others, std::size_t vertices) {
  LatticeCore core;
  core.is_deep.assign(vertices, 0);
  SiteMap map(lattice, vertex);
  SiteBlocks& sites = map.blocks();
  for_blocks(sites, core.is_deep, [](CoreFinder& finder, SiteBlock& block) { finder.find_whole_shapes(block); });
  map.discard_shapes_with(others);
  for_blocks(sites, core.is_deep, [](CoreFinder& finder, SiteBlock& block) { finder.find_deep_vertices(block); });
  core.cell_count = number_cells(sites, core.is_deep);
  core.sites = std::move(sites);
  return core;
}

}  // namespace ccdt::cores
