#include "engine/label/label_cells.h"

#include <atomic>
#include <bit>
#include <span>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/base/shared_union_find.h"

namespace ccdt::label {

using delaunay::cell_of, delaunay::face_of, delaunay::ghost_vertex, delaunay::no_neighbor;

namespace {

constexpr std::size_t grain = 4096;  // of loops on several threads

/// Eight bits per cell: the separating faces, set on both sides, and above them those that are open on this side.
using FaceBits = RawVector<std::uint8_t>;

CellLabels stuck_at(const plc::Plc& plc, const delaunay::Delaunay& d, std::uint32_t cell) {
  std::vector<Point3> points;
  for (const std::uint32_t v : d.cells[cell].vertices)
    if (v != ghost_vertex) points.push_back(d.point(v));
  return {{}, front::stuck_near("the front does not separate the inside from the outside", plc, points)};
}

FaceBits mark_walls(const delaunay::Delaunay& d, const std::vector<front::FrontFace>& open,
                    const std::vector<std::uint32_t>& wall_codes) {
  FaceBits bits(d.cells.size());
  parallel_fill(std::span(bits), std::uint8_t{0});
  const SetBits set_bits;
  const auto mark = [&](std::uint32_t code, unsigned what) {
    set_bits(bits[cell_of(code)], static_cast<std::uint8_t>(what << face_of(code)));
  };
  parallel_for(wall_codes.size(), grain, [&](std::size_t i) {
    if (wall_codes[i] == no_neighbor) return;
    mark(wall_codes[i], 0x01);
    mark(d.across(wall_codes[i]), 0x01);
  });
  parallel_for(open.size(), grain, [&](std::size_t i) {
    mark(open[i].code, 0x11);
    mark(d.across(open[i].code), 0x01);
  });
  return bits;
}

/// The parts of the tetrahedralization between the walls. They grow in the order of the cells in memory; a flood fill
/// would jump around.
SharedUnionFind join_cells(const delaunay::Delaunay& d, const FaceBits& bits) {
  SharedUnionFind parts(d.cells.size());
  parallel_for(d.cells.size(), grain, [&](std::size_t i) {
    const auto cell = static_cast<std::uint32_t>(i);
    if (d.is_dead(cell)) return;
    const auto& neighbors = d.cells[i].neighbors;
    unsigned joined = 0;  // a bit for each face towards a smaller cell of the same part
    for (std::uint32_t f = 0; f < 4; ++f) joined |= unsigned{cell_of(neighbors[f]) < cell} << f;
    std::uint32_t part = cell;
    for (joined &= ~unsigned{bits[i]}; joined != 0; joined &= joined - 1)
      part = parts.join(part, cell_of(neighbors[std::countr_zero(joined)]));
  });
  return parts;
}

void note_least(std::atomic<std::uint32_t>& least, std::uint32_t i) {
  std::uint32_t before = least.load(std::memory_order_relaxed);
  while (i < before && !least.compare_exchange_weak(before, i, std::memory_order_relaxed)) {
  }
}

/// A face of the PLC whose side toward a labeled cell was not open: the front has filled that side, so the labeled
/// part leaks into what the front has replaced.
/// \return a cell where this happens; `no_neighbor` if there is none
std::uint32_t find_leak(const delaunay::Delaunay& d, const FaceBits& bits, const std::vector<std::uint32_t>& wall_codes,
                        std::span<const RegionId> region) {
  const auto leaks = [&](std::uint32_t side) {
    const std::uint32_t cell = cell_of(side);
    return !region[cell].is_none() && !(bits[cell] >> face_of(side) & 0x10u);
  };
  std::atomic<std::uint32_t> leak = no_neighbor;
  parallel_for(wall_codes.size(), grain, [&](std::size_t i) {
    const std::uint32_t code = wall_codes[i];
    if (code != no_neighbor && (leaks(code) || leaks(d.across(code)))) note_least(leak, static_cast<std::uint32_t>(i));
  });
  if (leak == no_neighbor) return no_neighbor;
  const std::uint32_t code = wall_codes[leak];
  return cell_of(leaks(code) ? code : d.across(code));
}

}  // namespace

CellLabels label_cells(const plc::Plc& plc, const delaunay::Delaunay& d, const std::vector<front::FrontFace>& open,
                       const std::vector<std::uint32_t>& wall_codes) {
  const FaceBits bits = mark_walls(d, open, wall_codes);
  const RawVector<std::uint32_t> part_of = join_cells(d, bits).take_representatives();
  RawVector<RegionId> region(d.cells.size());
  parallel_fill(std::span(region), RegionId());
  for (const front::FrontFace& face : open) {
    RegionId& its = region[part_of[cell_of(face.code)]];
    if (!its.is_none() && its != face.region) return stuck_at(plc, d, cell_of(face.code));
    its = face.region;
  }
  // No wall divides the ghosts.
  std::uint32_t ghost = 0;
  while (d.is_dead(ghost) || !d.is_ghost(ghost)) ++ghost;
  if (!region[part_of[ghost]].is_none()) return stuck_at(plc, d, ghost);
  // A part gets the region of its first cell, which stays the same.
  parallel_for(d.cells.size(), grain, [&](std::size_t i) {
    const auto cell = static_cast<std::uint32_t>(i), first = part_of[cell];
    if (first != cell) region[cell] = region[first];
  });
  work_done.cells_visited += 2 * d.cells.size();
  note_bytes(bytes_of(bits, region, part_of));
  const std::uint32_t leak = find_leak(d, bits, wall_codes, region);
  if (leak != no_neighbor) return stuck_at(plc, d, leak);
  return {std::move(region)};
}

}  // namespace ccdt::label
