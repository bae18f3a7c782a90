#include "engine/cores/site_blocks.h"

#include <algorithm>
#include <cmath>

namespace ccdt::cores {
namespace {

/// No vertex blocks a shape whose place is farther from it than this, in steps and along any axis. The largest spheres
/// are those of the body-centered lattice: sqrt(5)/2 around a center that is 1/2 off the place.
constexpr std::uint32_t reach = 2;

/// Covers the rounding of squared distances in steps.
constexpr double rounding = 1e-6;

class Builder {
 public:
  explicit Builder(const lattice::LatticePoints& lattice) : lattice_(lattice) { all_.kind = lattice.kind; }

  SiteBlocks build(const std::vector<std::uint32_t>& vertex, const std::vector<Point3>& others) {
    make_levels();
    block_of_.resize(lattice_.points.size());
    for (std::uint32_t i = 0; i < lattice_.points.size(); ++i) {
      const auto c = coordinates(i);
      const std::uint32_t level = level_of(i, c);
      block_of_[i] = own_block(level, place(level, c));
      put(block_of_[i], place(level, c), vertex[i]);
    }
    for (std::uint32_t b = 0; b < all_.blocks.size(); ++b) find_neighbors(b);
    for (std::uint32_t i = 0; i < lattice_.points.size(); ++i)
      if (all_.blocks[block_of_[i]].near_levels != 0) meet_other_levels(i, vertex[i]);
    for (const Point3& p : others)
      for (std::uint32_t level = 0; level < all_.levels.size(); ++level) block_shapes(level, p);
    return std::move(all_);
  }

 private:
  void make_levels() {
    index_.assign(lattice_.depth + 1, nothing);
    for (const std::uint8_t level : lattice_.levels)
      for (unsigned l = level; l <= std::min(level + 1u, lattice_.depth); ++l) index_[l] = 0;
    index_[lattice_.depth] = 0;  // every point is a site of the finest level
    const unsigned whole = lattice_.kind == Lattice::sc ? 2 : 1;
    for (unsigned level = 0; level <= lattice_.depth; ++level) {
      if (index_[level] == nothing) continue;
      index_[level] = static_cast<std::uint32_t>(all_.levels.size());
      all_.levels.push_back({level, whole << (lattice_.depth - level), {}});
    }
  }

  Place coordinates(std::uint32_t i) const {
    const Point3 p = lattice_.points[i] - lattice_.origin;
    const auto whole = [&](double x) { return static_cast<std::uint32_t>(x / lattice_.unit); };
    return {whole(p.x), whole(p.y), whole(p.z)};
  }
  Place place(std::uint32_t level, const Place& c) const {
    const std::uint32_t step = all_.levels[level].step;
    return {c[0] / step + margin, c[1] / step + margin, c[2] / step + margin};
  }
  bool is_on(std::uint32_t level, const Place& c) const {
    const std::uint32_t rest = all_.levels[level].step - 1;
    return ((c[0] | c[1] | c[2]) & rest) == 0 && is_site(all_.kind, place(level, c));
  }
  /// A site of a fine leaf may be on the lower side of a coarser one.
  std::uint32_t level_of(std::uint32_t i, const Place& c) const {
    std::uint32_t level = index_[lattice_.levels[i]];
    while (!is_on(level, c)) ++level;
    return level;
  }

  std::uint32_t own_block(std::uint32_t level, const Place& p) {
    const Place at = {p[0] / SiteBlock::side, p[1] / SiteBlock::side, p[2] / SiteBlock::side};
    if (last_ < all_.blocks.size() && all_.blocks[last_].level == level && all_.blocks[last_].at == at) return last_;
    const auto [b, is_new] =
        all_.levels[level].blocks.insert(morton_code(at), static_cast<std::uint32_t>(all_.blocks.size()));
    if (is_new) {
      SiteBlock& block = all_.blocks.emplace_back();
      block.at = at, block.level = level;
      block.point.fill(nothing), block.cube.fill(nothing), block.flags.fill(0), block.kind.fill(0);
    }
    return last_ = *b;
  }

  void put(std::uint32_t block, const Place& p, std::uint32_t vertex) {
    if (vertex == nothing) return;
    const std::size_t i = SiteBlocks::place_in_block(p);
    all_.blocks[block].point[i] = vertex;
    all_.blocks[block].flags[i] |= present;
  }

  void find_neighbors(std::uint32_t b) {
    SiteBlock& block = all_.blocks[b];
    for (std::uint32_t i = 0; i < 27; ++i) {
      const std::uint32_t step[] = {i % 3, i / 3 % 3, i / 9};
      Place at = block.at;
      for (int k = 0; k < 3; ++k) at[k] += step[k] - 1;
      block.around[i] = all_.levels[block.level].blocks.get(morton_code(at), nothing);
    }
    for (std::uint32_t coarse = 0; coarse < block.level; ++coarse) find_coarser(b, coarse);
  }

  /// Notes of a block and those of a coarser level that they are near to each other.
  void find_coarser(std::uint32_t b, std::uint32_t coarse) {
    SiteBlock& block = all_.blocks[b];
    const std::int64_t step = all_.levels[block.level].step, coarse_step = all_.levels[coarse].step;
    Place low, high;
    for (int k = 0; k < 3; ++k) {
      const std::int64_t least = (std::int64_t{block.at[k]} * SiteBlock::side - margin) * step;
      const std::int64_t most = least + SiteBlock::side * step;
      const auto at = [&](std::int64_t c) {
        return static_cast<std::uint32_t>(std::max<std::int64_t>(c / coarse_step + margin, 0) / SiteBlock::side);
      };
      low[k] = at(least - (reach + 1) * coarse_step), high[k] = at(most + (reach + 1) * coarse_step);
    }
    for (Place at = low; at[2] <= high[2]; ++at[2])
      for (at[1] = low[1]; at[1] <= high[1]; ++at[1])
        for (at[0] = low[0]; at[0] <= high[0]; ++at[0]) {
          const std::uint32_t other = all_.levels[coarse].blocks.get(morton_code(at), nothing);
          if (other == nothing) continue;
          block.near_levels |= std::uint64_t{1} << coarse;
          all_.blocks[other].near_levels |= std::uint64_t{1} << block.level;
        }
  }

  /// A lattice point is a site of other levels as well, or it blocks their shapes.
  void meet_other_levels(std::uint32_t i, std::uint32_t vertex) {
    const auto c = coordinates(i);
    const SiteBlock& own = all_.blocks[block_of_[i]];
    for (std::uint32_t level = 0; level < all_.levels.size(); ++level) {
      if ((own.near_levels >> level & 1) == 0 || level == own.level) continue;
      if (!is_on(level, c)) {
        block_shapes(level, lattice_.points[i]);
      } else if (const std::uint32_t b = all_.find(level, place(level, c)); b != nothing) {
        put(b, place(level, c), vertex);
      }
    }
  }

  /// Marks the shapes of a level that have a point in one of their spheres.
  void block_shapes(std::uint32_t level, const Point3& p) {
    const double scale = 1 / (lattice_.unit * all_.levels[level].step);
    const Point3 from_origin = p - lattice_.origin;
    const std::array<double, 3> x = {from_origin.x * scale + margin, from_origin.y * scale + margin,
                                     from_origin.z * scale + margin};
    for (const double c : x)
      if (!(c > reach + 1 && c < 0x1p22)) return;
    Place low, high;
    for (int k = 0; k < 3; ++k) {
      low[k] = static_cast<std::uint32_t>(x[k]) - reach;
      high[k] = static_cast<std::uint32_t>(x[k]) + reach + 1;
    }
    constexpr std::uint32_t side = SiteBlock::side;
    for (std::uint32_t bz = low[2] / side; bz <= high[2] / side; ++bz)
      for (std::uint32_t by = low[1] / side; by <= high[1] / side; ++by)
        for (std::uint32_t bx = low[0] / side; bx <= high[0] / side; ++bx) {
          const std::uint32_t b = all_.levels[level].blocks.get(morton_code({bx, by, bz}), nothing);
          if (b == nothing) continue;
          const Place least = {std::max(low[0], bx * side), std::max(low[1], by * side), std::max(low[2], bz * side)};
          const Place most = {std::min(high[0], bx * side + side - 1), std::min(high[1], by * side + side - 1),
                              std::min(high[2], bz * side + side - 1)};
          block_shapes(all_.blocks[b], least, most, x);
        }
  }

  void block_shapes(SiteBlock& block, const Place& low, const Place& high, const std::array<double, 3>& x) const {
    for (Place p = low; p[2] <= high[2]; ++p[2])
      for (p[1] = low[1]; p[1] <= high[1]; ++p[1])
        for (p[0] = low[0]; p[0] <= high[0]; ++p[0]) {
          std::uint8_t& flags = block.flags[SiteBlocks::place_in_block(p)];
          if (is_in_sphere_at(p, x)) flags |= blocked_point;
          if (is_in_sphere_of_cube(p, x)) flags |= blocked_cube;
        }
  }

  /// The octahedron around a place has radius 1. The four tetrahedra around a face of a body-centered lattice have
  /// their centers 1/2 off it along the axes of the face, and the radius sqrt(5)/2.
  bool is_in_sphere_at(const Place& p, const std::array<double, 3>& x) const {
    std::array<double, 3> d;
    for (int k = 0; k < 3; ++k) d[k] = std::abs(x[k] - p[k]);
    const double squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (all_.kind == Lattice::fcc) return squared <= 1 + rounding;
    double along = 0;
    for (int k = 0; k < 3; ++k)
      if ((p[k] & 1) != 0) along = std::max(along, d[k]);
    return squared - along <= 1 + rounding;
  }

  static bool is_in_sphere_of_cube(const Place& p, const std::array<double, 3>& x) {
    double squared = 0;
    for (int k = 0; k < 3; ++k) squared += (x[k] - p[k] - 0.5) * (x[k] - p[k] - 0.5);
    return squared <= 0.75 + rounding;
  }

  const lattice::LatticePoints& lattice_;
  SiteBlocks all_;
  std::vector<std::uint32_t> index_;     ///< of a level, by that of the octree
  std::vector<std::uint32_t> block_of_;  ///< by point
  std::uint32_t last_ = 0;
};

}  // namespace

SiteBlocks make_site_blocks(const lattice::LatticePoints& lattice, const std::vector<std::uint32_t>& vertex,
                            const std::vector<Point3>& others) {
  return Builder(lattice).build(vertex, others);
}

}  // namespace ccdt::cores
