#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/hash_table.h"
#include "engine/base/morton.h"
#include "engine/base/raw_vector.h"
#include "engine/lattice/place_lattice_points.h"

namespace ccdt::cores {

using lattice::Lattice;

/// The flags of a site.
enum SiteFlag : std::uint8_t {
  present = 0x01,  ///< a vertex of the lattice is there
  deep = 0x02,     ///< that vertex is deep
};

/// The flags of the shapes at a place.
enum ShapeFlag : std::uint8_t {
  core_point = 0x01,  ///< the shape around the point is core
  core_cube = 0x02,   ///< the shape in the unit cube with this least corner is core
};

/// A cube of 8 x 8 x 8 places of one level, x first. A place is a point with whole coordinates in *steps*: half the
/// side of a lattice cell of the level, or the whole side for the simple cubic lattice.
///
/// Threads work on different blocks. No step writes to an array that it also reads in the surrounding blocks.
struct SiteBlock {
  static constexpr int side = 8;
  static constexpr std::size_t size = 512;

  std::array<std::uint32_t, 3> at;        ///< least place / side
  std::uint32_t level;                    ///< index of its `SiteLevel`
  bool has_core;                          ///< is any of its shapes core?
  std::uint32_t first_cell, cell_count;   ///< the cells of its shapes are first_cell .. first_cell + cell_count
  std::uint64_t near_levels;              ///< bits: levels that have a block near possible vertices of this one
  std::array<std::uint32_t, 27> around;   ///< the blocks around it, x first, itself included; `none` if missing
  std::array<std::uint32_t, size> point;  ///< at a site: its vertex; elsewhere: the first cell of a shape; or `none`
  std::array<std::uint32_t, size> cube;   ///< the first cell of the shape in the cube, or `none`
  std::array<std::uint8_t, size> flags;   ///< `SiteFlag`
  std::array<std::uint8_t, size> shapes;  ///< `ShapeFlag`
  std::array<std::uint8_t, size> kind;    ///< the split of a shape by the ranks of its vertices

  static std::size_t place(std::uint32_t x, std::uint32_t y, std::uint32_t z) { return x + side * (y + side * z); }
};

/// The lattice of one level of the octree.
struct SiteLevel {
  unsigned log_step = 0;  ///< a step is 2 to this power octree units
  HashTable<std::uint64_t, std::uint32_t> blocks;
};

using Place = std::array<std::uint32_t, 3>;

/// Offset of coordinates in steps, so that none is below zero around a site.
inline constexpr std::uint32_t margin = SiteBlock::side;

/// Is a place, in steps, a site of the lattice?
constexpr bool is_site(Lattice kind, const Place& p) {
  switch (kind) {
    case Lattice::fcc:
      return ((p[0] + p[1] + p[2]) & 1) == 0;
    case Lattice::bcc:
      return ((p[0] ^ p[1]) & 1) == 0 && ((p[0] ^ p[2]) & 1) == 0;
    default:
      return true;
  }
}

/// The sites of all levels near vertices, in blocks.
struct SiteBlocks {
  Lattice kind = Lattice::fcc;
  std::vector<SiteLevel> levels;  ///< coarse ones first
  RawVector<SiteBlock> blocks;

  std::uint32_t find(std::uint32_t level, const Place& p) const {
    return levels[level].blocks.get(
        morton_code({p[0] / SiteBlock::side, p[1] / SiteBlock::side, p[2] / SiteBlock::side}), none);
  }
  static std::size_t place_in_block(const Place& p) {
    return SiteBlock::place(p[0] % SiteBlock::side, p[1] % SiteBlock::side, p[2] % SiteBlock::side);
  }
};

/// The vertices of a lattice in blocks.
class SiteMap {
 public:
  /// \param lattice  must outlive this
  /// \param vertex   by point of the lattice: its vertex, or `none` if it is absent
  SiteMap(const lattice::LatticePoints& lattice, std::span<const std::uint32_t> vertex);

  SiteBlocks& blocks() { return all_; }
  /// Finds core shapes whose spheres contain lattice points of other levels, or any of the other vertices. These shapes
  /// are no longer core.
  void discard_shapes_with(std::span<const Point3> others);

 private:
  /// Consecutive points that are in one block.
  struct Run {
    std::uint32_t begin, end;  ///< of the points
    std::uint32_t level;       ///< index of their `SiteLevel`
    Place at;                  ///< of the block
    std::uint32_t block;
  };

  void make_levels();
  void find_runs();
  void make_blocks();
  Place coordinates(std::uint32_t point) const;
  Place place(std::uint32_t level, const Place& c) const;
  bool is_on(std::uint32_t level, const Place& c) const;
  std::uint32_t level_of(std::uint32_t point, const Place& c) const;
  void put(std::uint32_t block, const Place& p, std::uint32_t vertex);
  void put_on_other_levels(std::uint64_t near_levels, std::uint32_t point, std::uint32_t vertex);
  void find_neighbors(std::uint32_t b);
  void find_coarser(std::uint32_t b, std::uint32_t coarse);
  template <class Visit>
  void for_blocks_in(std::uint32_t level, const Place& low, const Place& high, const Visit& visit);
  void discard_shapes(std::uint32_t level, const Point3& p);
  void discard_shapes(SiteBlock& block, const Place& low, const Place& high, const std::array<double, 3>& x) const;

  const lattice::LatticePoints& lattice_;
  SiteBlocks all_;
  std::vector<std::uint32_t> index_;  ///< index of a level, by level of the octree
  std::vector<Run> runs_;
};

/// The side of a block with its surrounding places, and how far apart neighbors are in it along x, y and z.
inline constexpr int surrounded_side = SiteBlock::side + 2;
inline constexpr std::array<int, 3> stride = {1, surrounded_side, surrounded_side* surrounded_side};

/// The offset of a corner of a unit cube from its least corner, by the bits x, y, z of the corner.
constexpr int corner_offset(unsigned corner) {
  return static_cast<int>(corner & 1) * stride[0] + static_cast<int>(corner >> 1 & 1) * stride[1] +
         static_cast<int>(corner >> 2 & 1) * stride[2];
}

/// A copy of one array of a block, and of the places around it.
template <class T>
class Surrounded {
 public:
  void gather(const SiteBlocks& all, const SiteBlock& block, const std::array<T, SiteBlock::size> SiteBlock::*array,
              T otherwise) {
    int i = 0;
    for (int z = -1; z <= SiteBlock::side; ++z) {
      const int bz = z < 0 ? 0 : z < SiteBlock::side ? 1 : 2;
      for (int y = -1; y <= SiteBlock::side; ++y) {
        const int by = y < 0 ? 0 : y < SiteBlock::side ? 1 : 2;
        const int row = 3 * by + 9 * bz;
        const std::size_t first = SiteBlock::place(0, static_cast<unsigned>(y) & 7u, static_cast<unsigned>(z) & 7u);
        const auto from = [&](int bx, std::size_t x) {
          const std::uint32_t b = block.around[static_cast<std::size_t>(row + bx)];
          return b == none ? otherwise : (all.blocks[b].*array)[first + x];
        };
        values_[i++] = from(0, 7);
        const std::uint32_t middle = block.around[static_cast<std::size_t>(row + 1)];
        for (std::size_t x = 0; x < 8; ++x)
          values_[i++] = middle == none ? otherwise : (all.blocks[middle].*array)[first + x];
        values_[i++] = from(2, 0);
      }
    }
  }

  /// The index of a place of the block; neighbors are at it plus or minus the strides.
  static int index(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return static_cast<int>(x + 1 + surrounded_side * (y + 1 + surrounded_side * (z + 1)));
  }
  const T& operator[](int i) const { return values_[static_cast<std::size_t>(i)]; }

 private:
  std::array<T, surrounded_side * surrounded_side * surrounded_side> values_;
};

/// Calls visit(x, y, z, place in the block, index in its surroundings) for the places of a block.
template <class Visit>
void for_each_place(const Visit& visit) {
  for (std::uint32_t z = 0, i = 0; z < 8; ++z)
    for (std::uint32_t y = 0; y < 8; ++y)
      for (std::uint32_t x = 0; x < 8; ++x, ++i) visit(x, y, z, i, Surrounded<std::uint8_t>::index(x, y, z));
}

}  // namespace ccdt::cores
