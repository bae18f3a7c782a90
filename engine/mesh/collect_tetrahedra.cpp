#include "engine/mesh/collect_tetrahedra.h"

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <optional>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/platform.h"

namespace ccdt::mesh {
namespace {

using delaunay::Cell, delaunay::cell_of, delaunay::face_code, delaunay::face_of, delaunay::no_neighbor;
using Tetrahedron = std::array<std::uint32_t, 4>;

constexpr std::size_t grain = 4096;  // of loops on several threads

/// How the corners of a cell are arranged in its tetrahedron.
struct Arrangement {
  std::array<std::uint8_t, 4> corners;  ///< by place
  std::array<std::uint8_t, 4> places;   ///< by corner
};

/// The even permutations. Those that begin with the same corner are consecutive; each is the one before with the other
/// corners rotated.
constexpr std::array<Arrangement, 12> even_arrangements = [] {
  constexpr std::uint8_t first[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 0, 1, 3}, {3, 0, 2, 1}};
  std::array<Arrangement, 12> all{};
  for (unsigned i = 0; i < 12; ++i) {
    const auto& [a, b, c, d] = first[i / 3];
    const std::uint8_t others[] = {b, c, d};
    all[i].corners = {a, others[i % 3], others[(i + 1) % 3], others[(i + 2) % 3]};
    for (std::uint8_t place = 0; place < 4; ++place) all[i].places[all[i].corners[place]] = place;
  }
  return all;
}();

/// The number of the even arrangement with the least vertex first and the least of the others second. No branch depends
/// on the vertices: it would be mispredicted half the time.
unsigned arrangement_of(const Tetrahedron& t) {
  const unsigned low = t[1] < t[0] ? 1 : 0, high = t[3] < t[2] ? 3 : 2;
  const unsigned first = t[high] < t[low] ? high : low;
  const auto& corners = even_arrangements[3 * first].corners;
  const std::uint32_t b = t[corners[1]], c = t[corners[2]], d = t[corners[3]];
  const unsigned second = c < b ? 1 : 0;
  return 3 * first + (d < std::min(b, c) ? 2 : second);
}

/// A tetrahedron among those with the same least vertex. Comparing a few large numbers is fast.
struct BucketEntry {
  std::uint64_t second_and_third;  ///< vertices
  std::uint32_t fourth;
  std::uint32_t source;

  auto operator<=>(const BucketEntry&) const = default;
};

BucketEntry entry_of(const Tetrahedron& t, std::uint32_t source) {
  const auto& [a, b, c, d] = even_arrangements[arrangement_of(t)].corners;
  return {std::uint64_t{t[b]} << 32 | t[c], t[d], source};
}

std::uint32_t least_vertex(const Tetrahedron& t) {
  return std::min(std::min(t[0], t[1]), std::min(t[2], t[3]));
}

/// The labeled cells and the tetrahedra of the front, by their sources.
class Parts {
 public:
  Parts(const plc::Plc& plc, const front::FrontResult& front, RawVector<RegionId> region_of_cell,
        const LargeVector<Cell>& cells)
      : plc_(plc), front_(front), region_of_cell_(std::move(region_of_cell)), cells_(cells) {}

  std::size_t size() const { return cells_.size() + front_.tetrahedra.size(); }
  std::size_t bytes() const { return bytes_of(region_of_cell_); }
  bool is_in_mesh(std::size_t source) const { return !region(source).is_none(); }
  const Tetrahedron& operator[](std::size_t source) const {
    return source < cells_.size() ? cells_[source].vertices : front_.tetrahedra[source - cells_.size()];
  }
  int attribute(std::size_t source) const { return plc_.regions[region(source)].attribute; }
  void forget_regions() { release(region_of_cell_); }

 private:
  RegionId region(std::size_t source) const {
    return source < cells_.size() ? region_of_cell_[source] : front_.regions[source - cells_.size()];
  }

  const plc::Plc& plc_;
  const front::FrontResult& front_;
  RawVector<RegionId> region_of_cell_;
  const LargeVector<Cell>& cells_;
};

/// Lists of sources, by their least vertices. The order within a list is arbitrary.
struct Buckets {
  std::vector<std::uint32_t> ends;  ///< by vertex
  RawVector<std::uint32_t> sources;
};

Buckets group_by_least_vertex(const Parts& parts, std::size_t vertices) {
  const AddOne add_one;
  Buckets buckets;
  std::vector<std::uint32_t>& ends = buckets.ends;
  ends.assign(vertices + 1, 0);
  RawVector<std::uint32_t> least(parts.size());
  constexpr std::uint32_t not_in_mesh = delaunay::ghost_vertex;
  parallel_ranges(parts.size(), grain, [&](std::size_t i, std::size_t end) {
    std::uint32_t others = 0;
    // Which cells are in the mesh is unpredictable, so there is no branch.
    for (; i < end; ++i) {
      const std::uint32_t v = least[i] = std::max(least_vertex(parts[i]), parts.is_in_mesh(i) ? 0 : not_in_mesh);
      add_one(v == not_in_mesh ? others : ends[v + 1]);
    }
  });
  for (std::size_t v = 1; v < ends.size(); ++v) ends[v] += ends[v - 1];
  // At first, each entry is where its bucket begins. Each source moves it on, finally to where the bucket ends.
  buckets.sources.resize(ends.back());
  parallel_for(parts.size(), grain, [&](std::size_t i) {
    if (least[i] != not_in_mesh) buckets.sources[add_one(ends[least[i]])] = static_cast<std::uint32_t>(i);
  });
  ends.pop_back();
  return buckets;
}

}  // namespace

std::optional<int> common_attribute(std::span<const plc::Region> regions) {
  std::optional<int> common;
  for (const plc::Region& region : regions) {
    if (!region.inside) continue;
    if (region.attribute != common.value_or(region.attribute)) return std::nullopt;
    common = region.attribute;
  }
  return common;
}

CollectedMesh collect_tetrahedra(const plc::Plc& plc, const front::FrontResult& front,
                                 RawVector<RegionId> region_of_cell, const LargeVector<Cell>& cells,
                                 std::size_t vertices) {
  Parts parts(plc, front, std::move(region_of_cell), cells);
  CollectedMesh collected;
  auto& [mesh, sources] = collected;
  Buckets buckets = group_by_least_vertex(parts, vertices);
  sources = std::move(buckets.sources);
  const bool has_regions = !common_attribute(plc.regions);
  if (has_regions)
    mesh.regions.resize(sources.size());
  else
    parts.forget_regions();
  mesh.tetrahedra.resize(sources.size());
  parallel_ranges(vertices, grain, [&](std::size_t v, std::size_t end) {
    constexpr std::size_t ahead = 16;  // cells of a bucket are far apart, so memory is asked for them early
    const std::size_t last = buckets.ends[end - 1];
    std::vector<BucketEntry> bucket;
    for (; v < end; ++v) {
      bucket.clear();
      const std::size_t first = v == 0 ? 0 : buckets.ends[v - 1];
      for (std::size_t i = first; i < buckets.ends[v]; ++i) {
        if (i + ahead < last) prefetch(&parts[sources[i + ahead]]);
        bucket.push_back(entry_of(parts[sources[i]], sources[i]));
      }
      std::ranges::sort(bucket);
      for (std::size_t i = 0; i < bucket.size(); ++i) {
        const auto& [second_and_third, fourth, source] = bucket[i];
        mesh.tetrahedra[first + i] = {static_cast<std::uint32_t>(v), static_cast<std::uint32_t>(second_and_third >> 32),
                                      static_cast<std::uint32_t>(second_and_third), fourth};
        if (has_regions) mesh.regions[first + i] = parts.attribute(source);
        sources[first + i] = source;
      }
    }
  });
  note_bytes(bytes_of(cells, buckets.ends, sources, mesh.tetrahedra, mesh.regions) + parts.bytes());
  return collected;
}

LargeVector<Cell> join_tetrahedra(const TetMesh& mesh, RawVector<std::uint32_t> sources, LargeVector<Cell> cells) {
  const std::size_t cell_count = cells.size(), count = sources.size();
  if (cell_count < count) cells.resize(count);
  constexpr Tetrahedron no_neighbors = {no_neighbor, no_neighbor, no_neighbor, no_neighbor};
  constexpr std::uint32_t not_in_mesh = none;
  RawVector<std::uint32_t> tetrahedron_of(cell_count);
  parallel_fill(std::span(tetrahedron_of), not_in_mesh);
  parallel_for(count, grain, [&](std::size_t i) {
    if (sources[i] < cell_count) tetrahedron_of[sources[i]] = static_cast<std::uint32_t>(i);
  });
  const auto of_front = parallel_select(count, grain, [&](std::size_t i) { return sources[i] >= cell_count; });
  release(sources);
  RawVector<std::uint8_t> arrangements(cell_count);
  parallel_fill(std::span(arrangements), std::uint8_t{0});
  parallel_for(cell_count, grain, [&](std::size_t c) {
    if (tetrahedron_of[c] != not_in_mesh)
      arrangements[c] = static_cast<std::uint8_t>(arrangement_of(cells[c].vertices));
  });
  // The vertices of the cells are no longer needed. The new neighbors take their place until all are found.
  for (const std::uint32_t i : of_front) cells[i].vertices = no_neighbors;
  // Cells near each other in space are near each other in the Delaunay cells' order, so the search follows that order.
  parallel_for(cell_count, grain, [&](std::size_t c) {
    if (tetrahedron_of[c] == not_in_mesh) return;
    Tetrahedron& neighbors = cells[tetrahedron_of[c]].vertices;
    const auto& places = even_arrangements[arrangements[c]].places;
    for (std::uint32_t f = 0; f < 4; ++f) {
      const std::uint32_t code = cells[c].neighbors[f], other = tetrahedron_of[cell_of(code)];
      const auto& places_there = even_arrangements[arrangements[cell_of(code)]].places;
      neighbors[places[f]] = other == not_in_mesh ? no_neighbor : face_code(other, places_there[face_of(code)]);
    }
  });
  parallel_for(count, grain, [&](std::size_t i) { cells[i] = {mesh.tetrahedra[i], cells[i].vertices}; });
  cells.resize(count);
  note_bytes(bytes_of(mesh.tetrahedra, mesh.regions, cells));  // the same on any number of threads
  return cells;
}

}  // namespace ccdt::mesh
