#include "engine/cores/lattice_core.h"

#include <algorithm>
#include <utility>

#include "engine/cores/split_by_rank.h"

namespace ccdt::cores {
namespace {

using Flags = Surrounded<std::uint8_t>;
using Numbers = Surrounded<std::uint32_t>;

constexpr auto stride = Flags::stride;

/// The offset of a corner of a unit cube from its least corner, by the bits x, y, z of the corner.
constexpr int corner_offset(unsigned corner) {
  return static_cast<int>(corner & 1) * stride[0] + static_cast<int>(corner >> 1 & 1) * stride[1] +
         static_cast<int>(corner >> 2 & 1) * stride[2];
}

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

class CoreFinder {
 public:
  CoreFinder(SiteBlocks& sites, std::vector<bool>& is_deep) : sites_(sites), kind_(sites.kind), is_deep_(is_deep) {}

  void find_whole_shapes() {
    for (SiteBlock& block : sites_.blocks) find_whole_shapes(block);
  }

  std::uint32_t find_deep_vertices() {
    for (SiteBlock& block : sites_.blocks) find_deep_vertices(block);
    for (SiteBlock& block : sites_.blocks) number_cells(block);
    return cells_;
  }

 private:
  /// Finds the shapes with all their vertices.
  void find_whole_shapes(SiteBlock& block) {
    around_.gather(sites_, block, &SiteBlock::flags, 0);
    const auto is_present = [&](int i) { return (around_[i] & present) != 0; };
    for_each_place([&](std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t i, int at) {
      const Place p = {x, y, z};
      std::uint8_t& flags = block.flags[i];
      if (has_shape_at(kind_, p) && for_vertices_at(kind_, p, at, is_present)) flags |= core_point;
      if (has_cubes(kind_) && for_vertices_of_cube(kind_, p, at, is_present)) flags |= core_cube;
      if ((flags & (core_point | core_cube)) != 0) block.has_core = true;
    });
  }

  void find_deep_vertices(SiteBlock& block) {
    around_.gather(sites_, block, &SiteBlock::flags, 0);
    for_each_place([&](std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t i, int at) {
      if ((block.flags[i] & present) == 0 || !is_deep({x, y, z}, at)) return;
      block.flags[i] |= deep;
      is_deep_[block.point[i]] = true;
    });
  }

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

  /// Numbers the cells of core shapes with a deep vertex.
  void number_cells(SiteBlock& block) {
    around_.gather(sites_, block, &SiteBlock::flags, 0);
    vertex_.gather(sites_, block, &SiteBlock::point, nothing);
    const auto is_not_deep = [&](int i) { return (around_[i] & deep) == 0; };
    for_each_place([&](std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t i, int at) {
      const Place p = {x, y, z};
      if ((block.flags[i] & core_point) != 0 && !for_vertices_at(kind_, p, at, is_not_deep)) {
        block.point[i] = cells_;
        cells_ += 4;
        if (kind_ == Lattice::fcc) {
          for (int k = 0; k < 3; ++k)
            corners_[2 * k] = vertex_[at - stride[k]], corners_[2 * k + 1] = vertex_[at + stride[k]];
          block.kind[i] = static_cast<std::uint8_t>(diagonal_of_octahedron(corners_.data()));
        }
      }
      if ((block.flags[i] & core_cube) != 0 && !for_vertices_of_cube(kind_, p, at, is_not_deep)) {
        block.cube[i] = cells_;
        if (kind_ == Lattice::fcc) {
          ++cells_;
        } else {
          for (unsigned c = 0; c < 8; ++c) corners_[c] = vertex_[at + corner_offset(c)];
          block.kind[i] = kind_of_cube(corners_);
          cells_ += split_of_kind(block.kind[i]).count;
        }
      }
    });
  }

  SiteBlocks& sites_;
  const Lattice kind_;
  std::vector<bool>& is_deep_;
  std::uint32_t cells_ = 0;
  Flags around_;
  Numbers vertex_;
  std::array<std::uint32_t, 8> corners_{};
};

}  // namespace

LatticeCore find_lattice_core(const lattice::LatticePoints& lattice, const std::vector<std::uint32_t>& vertex,
                              std::span<const Point3> others, std::size_t vertices) {
  LatticeCore core;
  core.is_deep.assign(vertices, false);
  SiteMap map(lattice, vertex);
  CoreFinder finder(map.blocks(), core.is_deep);
  finder.find_whole_shapes();
  map.discard_shapes_with(others);
  core.cell_count = finder.find_deep_vertices();
  core.sites = std::move(map.blocks());
  return core;
}

}  // namespace ccdt::cores
