#include "engine/cores/site_blocks.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/base/parallel.h"
#include "engine/base/platform.h"

namespace ccdt::cores {
namespace {

/// A vertex at x, in steps, is in no sphere of a shape whose place is below floor(x) - reach_below or above floor(x) +
/// reach_above. The spheres that reach farthest are those of the body-centered lattice: their radius is sqrt(5)/2, and
/// their centers are 1/2 off the place.
constexpr std::uint32_t reach_below = 1, reach_above = 2;

/// Covers the rounding of squared distances in steps.
constexpr double rounding = 1e-6;

// How many points, runs and blocks one thread takes at a time.
constexpr std::size_t point_grain = 1 << 14, run_grain = 16, block_grain = 64;

Place block_at(const Place& p) {
  return {p[0] / SiteBlock::side, p[1] / SiteBlock::side, p[2] / SiteBlock::side};
}

/// Is x in a sphere of the shape around a place? The octahedron of the face-centered lattice has radius 1. The four
/// tetrahedra around a face of the body-centered lattice have centers 1/2 off the place along the axes of the face, and
/// radius sqrt(5)/2.
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

/// Several threads may note levels of the same block.
void note_near_level(SiteBlock& block, std::uint32_t level) {
  as_atomic(block.near_levels).fetch_or(std::uint64_t{1} << level, std::memory_order_relaxed);
}

}  // namespace

SiteMap::SiteMap(const lattice::LatticePoints& lattice, std::span<const std::uint32_t> vertex) : lattice_(lattice) {
  all_.kind = lattice.kind;
  make_levels();
  find_runs();
  make_blocks();
  // Each place belongs to at most one point, so no two threads write to the same place.
  parallel_for(runs_.size(), run_grain, [&](std::size_t r) {
    const Run& run = runs_[r];
    for (std::uint32_t i = run.begin; i < run.end; ++i) put(run.block, place(run.level, coordinates(i)), vertex[i]);
  });
  parallel_for(all_.blocks.size(), block_grain, [&](std::size_t b) { find_neighbors(static_cast<std::uint32_t>(b)); });
  parallel_for(runs_.size(), run_grain, [&](std::size_t r) {
    const Run& run = runs_[r];
    const std::uint64_t near_levels = all_.blocks[run.block].near_levels;
    if (near_levels == 0) return;
    for (std::uint32_t i = run.begin; i < run.end; ++i) put_on_other_levels(near_levels, i, vertex[i]);
  });
}

/// The levels with points. A point of a level may be a site of the next finer level only.
void SiteMap::make_levels() {
  index_.assign(lattice_.depth + 1, none);
  for (const std::uint8_t level : lattice_.levels)
    for (unsigned l = level; l <= std::min(level + 1u, lattice_.depth); ++l) index_[l] = 0;
  index_[lattice_.depth] = 0;  // every point is a site of the finest level
  const unsigned log_whole = lattice_.kind == Lattice::sc ? 1 : 0;
  for (unsigned level = 0; level <= lattice_.depth; ++level) {
    if (index_[level] == none) continue;
    index_[level] = static_cast<std::uint32_t>(all_.levels.size());
    all_.levels.push_back({log_whole + lattice_.depth - level, {}});
  }
}

/// Consecutive points are near each other, so most runs hold all points of a block.
void SiteMap::find_runs() {
  runs_ = parallel_collect<Run>(lattice_.points.size(), point_grain,
                                [&](std::size_t begin, std::size_t end, std::vector<Run>& runs) {
                                  const std::size_t first = runs.size();
                                  for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
                                    const Place c = coordinates(i);
                                    const std::uint32_t level = level_of(i, c);
                                    const Place at = block_at(place(level, c));
                                    if (runs.size() == first || runs.back().level != level || runs.back().at != at)
                                      runs.push_back({i, i, level, at, none});
                                    runs.back().end = i + 1;
                                  }
                                });
}

void SiteMap::make_blocks() {
  std::vector<std::uint32_t> first_runs;  // by block
  for (std::uint32_t r = 0; r < runs_.size(); ++r) {
    const auto next = static_cast<std::uint32_t>(first_runs.size());
    const auto [block, is_new] = all_.levels[runs_[r].level].blocks.insert(morton_code(runs_[r].at), next);
    if (is_new) first_runs.push_back(r);
    runs_[r].block = *block;
  }
  all_.blocks.resize(first_runs.size());
  parallel_for(first_runs.size(), block_grain, [&](std::size_t b) {
    const Run& run = runs_[first_runs[b]];
    SiteBlock& block = all_.blocks[b];
    block.at = run.at, block.level = run.level;
    block.has_core = false, block.near_levels = 0, block.first_cell = 0, block.cell_count = 0;
    block.point.fill(none), block.cube.fill(none);
    block.flags.fill(0), block.shapes.fill(0), block.kind.fill(0);
  });
}

Place SiteMap::coordinates(std::uint32_t point) const {
  const Point3 p = (1 / lattice_.unit) * (lattice_.points[point] - lattice_.origin);
  constexpr double slack = 0.25;  // they are whole up to rounding
  const auto whole = [](double x) { return static_cast<std::uint32_t>(x + slack); };
  return {whole(p.x), whole(p.y), whole(p.z)};
}

Place SiteMap::place(std::uint32_t level, const Place& c) const {
  const unsigned log_step = all_.levels[level].log_step;
  return {(c[0] >> log_step) + margin, (c[1] >> log_step) + margin, (c[2] >> log_step) + margin};
}

bool SiteMap::is_on(std::uint32_t level, const Place& c) const {
  const std::uint32_t rest = (1u << all_.levels[level].log_step) - 1;
  return ((c[0] | c[1] | c[2]) & rest) == 0 && is_site(all_.kind, place(level, c));
}

/// A site of a fine leaf may be on the lower side of a coarser leaf.
std::uint32_t SiteMap::level_of(std::uint32_t point, const Place& c) const {
  std::uint32_t level = index_[lattice_.levels[point]];
  while (!is_on(level, c)) ++level;
  return level;
}

void SiteMap::put(std::uint32_t block, const Place& p, std::uint32_t vertex) {
  if (vertex == none) return;
  const std::size_t i = SiteBlocks::place_in_block(p);
  all_.blocks[block].point[i] = vertex;
  all_.blocks[block].flags[i] |= present;
}

/// A point is a site of all finer lattices, and of some coarser ones.
void SiteMap::put_on_other_levels(std::uint64_t near_levels, std::uint32_t point, std::uint32_t vertex) {
  if (vertex == none) return;
  const auto c = coordinates(point);
  for (std::uint32_t level = 0; level < all_.levels.size(); ++level) {
    if ((near_levels >> level & 1) == 0 || !is_on(level, c)) continue;
    if (const std::uint32_t b = all_.find(level, place(level, c)); b != none) put(b, place(level, c), vertex);
  }
}

void SiteMap::find_neighbors(std::uint32_t b) {
  SiteBlock& block = all_.blocks[b];
  for (std::uint32_t i = 0; i < 27; ++i) {
    const std::uint32_t step[] = {i % 3, i / 3 % 3, i / 9};
    Place at = block.at;
    for (int k = 0; k < 3; ++k) at[k] += step[k] - 1;
    block.around[i] = all_.levels[block.level].blocks.get(morton_code(at), none);
  }
  for (std::uint32_t coarse = 0; coarse < block.level; ++coarse) find_coarser(b, coarse);
}

/// Notes that a block and blocks of a coarser level are near each other.
void SiteMap::find_coarser(std::uint32_t b, std::uint32_t coarse) {
  SiteBlock& block = all_.blocks[b];
  const std::int64_t step = std::int64_t{1} << all_.levels[block.level].log_step;
  const std::int64_t coarse_step = std::int64_t{1} << all_.levels[coarse].log_step;
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
        const std::uint32_t other = all_.levels[coarse].blocks.get(morton_code(at), none);
        if (other == none) continue;
        note_near_level(block, coarse);
        note_near_level(all_.blocks[other], block.level);
      }
}

void SiteMap::discard_shapes_with(std::span<const Point3> others) {
  parallel_for(runs_.size(), run_grain, [&](std::size_t r) {
    const Run& run = runs_[r];
    const std::uint64_t near_levels = all_.blocks[run.block].near_levels;
    for (std::uint32_t level = 0; level < run.level; ++level) {
      if ((near_levels >> level & 1) == 0) continue;
      for (std::uint32_t i = run.begin; i < run.end; ++i)
        if (!is_on(level, coordinates(i))) discard_shapes(level, lattice_.points[i]);
    }
  });
  parallel_for(others.size(), 256, [&](std::size_t i) {
    for (std::uint32_t level = 0; level < all_.levels.size(); ++level) discard_shapes(level, others[i]);
  });
}

/// Calls visit(block, low, high) for the parts of a box of places that are in blocks with core shapes.
template <class Visit>
void SiteMap::for_blocks_in(std::uint32_t level, const Place& low, const Place& high, const Visit& visit) {
  constexpr std::uint32_t side = SiteBlock::side;
  const Place first = block_at(low), last = block_at(high);
  for (Place at = first; at[2] <= last[2]; ++at[2])
    for (at[1] = first[1]; at[1] <= last[1]; ++at[1])
      for (at[0] = first[0]; at[0] <= last[0]; ++at[0]) {
        const std::uint32_t b = all_.levels[level].blocks.get(morton_code(at), none);
        if (b == none || !all_.blocks[b].has_core) continue;
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
  const double scale = 1 / (lattice_.unit * (1u << all_.levels[level].log_step));
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
        // Several threads may discard shapes of the same block.
        const auto shapes = as_atomic(block.shapes[SiteBlock::place(p[0], p[1], p[2])]);
        const std::uint8_t core = shapes.load(std::memory_order_relaxed);
        std::uint8_t left = core;
        if ((core & core_point) != 0 && is_in_sphere_at(all_.kind, p, x)) left &= core_cube;
        if ((core & core_cube) != 0 && is_in_sphere_of_cube(p, x)) left &= core_point;
        if (left != core) shapes.fetch_and(left, std::memory_order_relaxed);
      }
}

}  // namespace ccdt::cores
