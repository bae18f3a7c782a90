#include "engine/cores/site_blocks.h"

#include <algorithm>
#include <cmath>

namespace ccdt::cores {
namespace {

/// A vertex at x, in steps, is in no sphere of a shape whose place is below floor(x) - reach_below or above floor(x) +
/// reach_above. The spheres that reach farthest are those of the body-centered lattice: their radius is sqrt(5)/2,
/// their centers are 1/2 off the place.
constexpr std::uint32_t reach_below = 1, reach_above = 2;

/// Covers the rounding of squared distances in steps.
constexpr double rounding = 1e-6;

Place block_at(const Place& p) {
  return {p[0] / SiteBlock::side, p[1] / SiteBlock::side, p[2] / SiteBlock::side};
}

/// Is x in a sphere of the shape around a place? The octahedron of the face-centered lattice has radius 1. The four
/// tetrahedra around a face of the body-centered lattice have their centers 1/2 off the place along the axes of the
/// face, and the radius sqrt(5)/2.
bool is_in_sphere_at(Lattice kind, const Place& p, const std::array<double, 3>& x) {
  double squared = 0, along = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = std::abs(x[k] - p[k]);
    squared += d * d;
    if (kind == Lattice::bcc && (p[k] & 1) != 0) along = std::max(along, d);
  }
  return squared - along <= 1 + rounding;
}

bool is_in_sphere_of_cube(const Place& p, const std::array<double, 3>& x) {
  double squared = 0;
  for (std::size_t k = 0; k < 3; ++k) squared += (x[k] - p[k] - 0.5) * (x[k] - p[k] - 0.5);
  return squared <= 0.75 + rounding;
}

}  // namespace

SiteMap::SiteMap(const lattice::LatticePoints& lattice, const std::vector<std::uint32_t>& vertex)
    : lattice_(lattice), block_of_(lattice.points.size()) {
  all_.kind = lattice.kind;
  make_levels();
  for (std::uint32_t i = 0; i < lattice_.points.size(); ++i) {
    const auto c = coordinates(i);
    const std::uint32_t level = level_of(i, c);
    block_of_[i] = own_block(level, place(level, c));
    put(block_of_[i], place(level, c), vertex[i]);
  }
  for (std::uint32_t b = 0; b < all_.blocks.size(); ++b) find_neighbors(b);
  for (std::uint32_t i = 0; i < lattice_.points.size(); ++i) put_on_other_levels(i, vertex[i]);
}

/// The levels with points. A point of a level may be a site of only the next finer one.
void SiteMap::make_levels() {
  index_.assign(lattice_.depth + 1, nothing);
  for (const std::uint8_t level : lattice_.levels)
    for (unsigned l = level; l <= std::min(level + 1u, lattice_.depth); ++l) index_[l] = 0;
  index_[lattice_.depth] = 0;  // every point is a site of the finest level
  const unsigned whole = lattice_.kind == Lattice::sc ? 2 : 1;
  for (unsigned level = 0; level <= lattice_.depth; ++level) {
    if (index_[level] == nothing) continue;
    index_[level] = static_cast<std::uint32_t>(all_.levels.size());
    all_.levels.push_back({whole << (lattice_.depth - level), {}});
  }
}

Place SiteMap::coordinates(std::uint32_t point) const {
  const Point3 p = lattice_.points[point] - lattice_.origin;
  const auto whole = [&](double x) { return static_cast<std::uint32_t>(x / lattice_.unit); };
  return {whole(p.x), whole(p.y), whole(p.z)};
}

Place SiteMap::place(std::uint32_t level, const Place& c) const {
  const std::uint32_t step = all_.levels[level].step;  // a power of two
  return {c[0] / step + margin, c[1] / step + margin, c[2] / step + margin};
}

bool SiteMap::is_on(std::uint32_t level, const Place& c) const {
  const std::uint32_t rest = all_.levels[level].step - 1;
  return ((c[0] | c[1] | c[2]) & rest) == 0 && is_site(all_.kind, place(level, c));
}

/// A site of a fine leaf may be on the lower side of a coarser one.
std::uint32_t SiteMap::level_of(std::uint32_t point, const Place& c) const {
  std::uint32_t level = index_[lattice_.levels[point]];
  while (!is_on(level, c)) ++level;
  return level;
}

std::uint32_t SiteMap::own_block(std::uint32_t level, const Place& p) {
  const Place at = block_at(p);
  const std::uint64_t key = morton_code(at);
  if (key == last_key_ && level == last_level_) return last_;
  last_key_ = key, last_level_ = level;
  const auto [b, is_new] = all_.levels[level].blocks.insert(key, static_cast<std::uint32_t>(all_.blocks.size()));
  if (is_new) {
    SiteBlock& block = all_.blocks.emplace_back();
    block.at = at, block.level = level;
    block.point.fill(nothing), block.cube.fill(nothing), block.flags.fill(0), block.kind.fill(0);
  }
  return last_ = *b;
}

void SiteMap::put(std::uint32_t block, const Place& p, std::uint32_t vertex) {
  if (vertex == nothing) return;
  const std::size_t i = SiteBlocks::place_in_block(p);
  all_.blocks[block].point[i] = vertex;
  all_.blocks[block].flags[i] |= present;
}

/// A point is a site of all finer lattices, and of some coarser ones.
void SiteMap::put_on_other_levels(std::uint32_t point, std::uint32_t vertex) {
  const SiteBlock& own = all_.blocks[block_of_[point]];
  if (own.near_levels == 0 || vertex == nothing) return;
  const auto c = coordinates(point);
  for (std::uint32_t level = 0; level < all_.levels.size(); ++level) {
    if ((own.near_levels >> level & 1) == 0 || !is_on(level, c)) continue;
    if (const std::uint32_t b = all_.find(level, place(level, c)); b != nothing) put(b, place(level, c), vertex);
  }
}

void SiteMap::find_neighbors(std::uint32_t b) {
  SiteBlock& block = all_.blocks[b];
  for (std::uint32_t i = 0; i < 27; ++i) {
    const std::uint32_t step[] = {i % 3, i / 3 % 3, i / 9};
    Place at = block.at;
    for (int k = 0; k < 3; ++k) at[k] += step[k] - 1;
    block.around[i] = all_.levels[block.level].blocks.get(morton_code(at), nothing);
  }
  for (std::uint32_t coarse = 0; coarse < block.level; ++coarse) find_coarser(b, coarse);
}

/// Notes that a block and those of a coarser level are near each other.
void SiteMap::find_coarser(std::uint32_t b, std::uint32_t coarse) {
  SiteBlock& block = all_.blocks[b];
  const std::int64_t step = all_.levels[block.level].step, coarse_step = all_.levels[coarse].step;
  Place low, high;
  for (int k = 0; k < 3; ++k) {
    const std::int64_t least = (std::int64_t{block.at[k]} * SiteBlock::side - margin) * step;
    const std::int64_t most = least + SiteBlock::side * step;
    low[k] = static_cast<std::uint32_t>(least / coarse_step + margin - reach_below - 1);
    high[k] = static_cast<std::uint32_t>(most / coarse_step + margin + reach_above + 1);
  }
  low = block_at(low), high = block_at(high);
  for (Place at = low; at[2] <= high[2]; ++at[2])
    for (at[1] = low[1]; at[1] <= high[1]; ++at[1])
      for (at[0] = low[0]; at[0] <= high[0]; ++at[0]) {
        const std::uint32_t other = all_.levels[coarse].blocks.get(morton_code(at), nothing);
        if (other == nothing) continue;
        block.near_levels |= std::uint64_t{1} << coarse;
        all_.blocks[other].near_levels |= std::uint64_t{1} << block.level;
      }
}

void SiteMap::discard_shapes_with(std::span<const Point3> others) {
  for (std::uint32_t i = 0; i < lattice_.points.size(); ++i) {
    const SiteBlock& own = all_.blocks[block_of_[i]];
    for (std::uint32_t level = 0; level < own.level; ++level)
      if ((own.near_levels >> level & 1) != 0 && !is_on(level, coordinates(i)))
        discard_shapes(level, lattice_.points[i]);
  }
  for (const Point3& p : others)
    for (std::uint32_t level = 0; level < all_.levels.size(); ++level) discard_shapes(level, p);
}

/// Calls visit(block, low, high) for the parts of a box of places that are in blocks with core shapes.
template <class Visit>
void SiteMap::for_blocks_in(std::uint32_t level, const Place& low, const Place& high, const Visit& visit) {
  constexpr std::uint32_t side = SiteBlock::side;
  const Place first = block_at(low), last = block_at(high);
  for (Place at = first; at[2] <= last[2]; ++at[2])
    for (at[1] = first[1]; at[1] <= last[1]; ++at[1])
      for (at[0] = first[0]; at[0] <= last[0]; ++at[0]) {
        const std::uint32_t b = all_.levels[level].blocks.get(morton_code(at), nothing);
        if (b == nothing || !all_.blocks[b].has_core) continue;
        Place from, to;
        for (std::size_t k = 0; k < 3; ++k) {
          from[k] = std::max(low[k], at[k] * side) % side;
          to[k] = std::min(high[k], at[k] * side + side - 1) % side;
        }
        visit(all_.blocks[b], from, to);
      }
}

/// Shapes of a level with a point in one of their spheres are no longer core.
void SiteMap::discard_shapes(std::uint32_t level, const Point3& p) {
  const double scale = 1 / (lattice_.unit * all_.levels[level].step);
  const Point3 from_origin = p - lattice_.origin;
  const std::array<double, 3> x = {from_origin.x * scale + margin, from_origin.y * scale + margin,
                                   from_origin.z * scale + margin};
  if (!std::ranges::all_of(x, [](double c) { return c > reach_below + 1 && c < 0x1p22; })) return;
  Place low, high;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = static_cast<std::uint32_t>(x[k]) - reach_below;
    high[k] = static_cast<std::uint32_t>(x[k]) + reach_above;
  }
  for_blocks_in(level, low, high, [&](SiteBlock& block, const Place& from, const Place& to) {
    std::array<double, 3> in_block;
    for (std::size_t k = 0; k < 3; ++k) in_block[k] = x[k] - block.at[k] * SiteBlock::side;
    discard_shapes(block, from, to, in_block);
  });
}

void SiteMap::discard_shapes(SiteBlock& block, const Place& low, const Place& high,
                             const std::array<double, 3>& x) const {
  for (Place p = low; p[2] <= high[2]; ++p[2])
    for (p[1] = low[1]; p[1] <= high[1]; ++p[1])
      for (p[0] = low[0]; p[0] <= high[0]; ++p[0]) {
        std::uint8_t& flags = block.flags[SiteBlock::place(p[0], p[1], p[2])];
        if ((flags & core_point) != 0 && is_in_sphere_at(all_.kind, p, x))
          flags = static_cast<std::uint8_t>(flags & ~core_point);
        if ((flags & core_cube) != 0 && is_in_sphere_of_cube(p, x))
          flags = static_cast<std::uint8_t>(flags & ~core_cube);
      }
}

}  // namespace ccdt::cores
