#include "engine/label/label_cells.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <span>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/index_lists.h"
#include "engine/base/parallel.h"
#include "engine/base/platform.h"
#include "engine/base/raw_vector.h"
#include "engine/front/stuck.h"

namespace ccdt::label {

using delaunay::cell_of, delaunay::face_of, delaunay::ghost_vertex, delaunay::no_neighbor;

namespace {

constexpr std::size_t grain = 4096;  // of loops on several threads

/// Eight bits per cell. The low four: separating faces, set on both sides. The high four: those that are open on this
/// side.
using FaceBits = RawVector<std::uint8_t>;

[[noreturn]] void refuse(const plc::Plc& plc, const delaunay::Delaunay& d, std::uint32_t cell) {
  std::vector<Point3> points;
  for (const std::uint32_t v : d.cells[cell].vertices)
    if (v != ghost_vertex) points.push_back(d.point(v));
  throw front::stuck_near("the front does not separate the inside from the outside", plc, points);
}

FaceBits mark_walls(const delaunay::Delaunay& d, const std::vector<front::FrontFace>& open,
                    const std::vector<std::uint32_t>& wall_codes) {
  FaceBits bits(d.cells.size());
  parallel_fill(std::span(bits), std::uint8_t{0});
  const SetBits set_bits;
  /// \return  was it a wall before?
  const auto mark = [&](std::uint32_t code, unsigned what) {
    const std::uint8_t before = set_bits(bits[cell_of(code)], static_cast<std::uint8_t>(what << face_of(code)));
    return (before >> face_of(code) & 1) != 0;
  };
  parallel_for(wall_codes.size(), grain, [&](std::size_t i) {
    d.prefetch_after(i, wall_codes);
    if (wall_codes[i] == no_neighbor) return;
    mark(wall_codes[i], 0x01);
    mark(d.across(wall_codes[i]), 0x01);
  });
  parallel_for(open.size(), grain, [&](std::size_t i) {
    // Nearly all are faces of the PLC, and already marked on both sides.
    if (!mark(open[i].code, 0x11)) mark(d.across(open[i].code), 0x01);
  });
  return bits;
}

void note_least(std::uint32_t& least, std::uint32_t i) {
  const auto shared = as_atomic(least);
  std::uint32_t before = shared.load(std::memory_order_relaxed);
  while (i < before && !shared.compare_exchange_weak(before, i, std::memory_order_relaxed)) {
  }
}

/// Labels all cells that are connected to the first ones with the region of these.
class RegionFlood {
 public:
  RegionFlood(const delaunay::Delaunay& d, const FaceBits& bits, RawVector<RegionId>& region)
      : d_(d), bits_(bits), region_(region), is_reached_(d.cells.size()) {
    parallel_fill(std::span(is_reached_), std::uint8_t{0});
  }

  /// Each thread starts from a share of the first cells, which are in memory order, so that the cells it reaches are
  /// close together.
  void spread(std::span<const std::uint32_t> first, RegionId region) {
    constexpr std::size_t least_share = 1024;
    parallel_ranges(first.size(), std::max(first.size() / thread_count() + 1, least_share),
                    [&](std::size_t begin, std::size_t end) {
                      std::vector<std::uint32_t> cells, next;
                      for (; begin < end; ++begin)
                        if (reach(first[begin])) cells.push_back(first[begin]);
                      for (; !cells.empty(); cells.swap(next)) {
                        label(cells, region);
                        next.clear();
                        for (std::size_t i = 0; i < cells.size(); i += a_few) reach_neighbors(cells, i, next);
                      }
                    });
  }

  /// The least labeled cell behind a wall that is not open on its side: the front has filled that side, so the labeled
  /// part leaks into the space that the front has filled. `none` if there is none.
  std::uint32_t leak() const { return leak_; }

  std::size_t bytes() const { return bytes_of(is_reached_); }

 private:
  /// Is the cell reached for the first time?
  bool reach(std::uint32_t cell) { return set_bits_(is_reached_[cell], 1) == 0; }

  void label(std::span<const std::uint32_t> cells, RegionId region) {
    for (const std::uint32_t cell : cells) region_[cell] = region;
    work_done.cells_visited += cells.size();
  }

  /// Adds the cells reached from a few cells. It is unpredictable whether a neighbor is reached for the first time, so
  /// no branch depends on it.
  ///
  /// \param i  the first of them
  void reach_neighbors(std::span<const std::uint32_t> cells, std::size_t i, std::vector<std::uint32_t>& found) {
    constexpr std::size_t ahead = 16;
    std::array<std::uint32_t, 4 * a_few> reached;
    std::size_t count = 0;
    for (const std::size_t end = std::min(i + a_few, cells.size()); i < end; ++i) {
      if (i + ahead < cells.size()) {
        prefetch(&d_.cells[cells[i + ahead]]);
        prefetch(&bits_[cells[i + ahead]]);
      }
      const std::uint32_t cell = cells[i];
      const unsigned walls = bits_[cell] & 0x0Fu, open = bits_[cell] >> 4;
      if ((walls & ~open) != 0) note_least(leak_, cell);
      for (std::uint32_t f = 0; f < 4; ++f) {
        const bool is_wall = (walls >> f & 1) != 0;
        const std::uint32_t next = is_wall ? cell : cell_of(d_.cells[cell].neighbors[f]);
        reached[count] = next;
        count += reach(next);
      }
    }
    found.insert(found.end(), reached.begin(), reached.begin() + static_cast<std::ptrdiff_t>(count));
  }

  static constexpr std::size_t a_few = 64;

  const delaunay::Delaunay& d_;
  const FaceBits& bits_;
  RawVector<RegionId>& region_;
  RawVector<std::uint8_t> is_reached_;  ///< by cell; stays in the cache, unlike the regions
  std::uint32_t leak_ = none;
  const SetBits set_bits_;
};

}  // namespace

RawVector<RegionId> label_cells(const plc::Plc& plc, const delaunay::Delaunay& d,
                                const std::vector<front::FrontFace>& open,
                                const std::vector<std::uint32_t>& wall_codes) {
  const FaceBits bits = mark_walls(d, open, wall_codes);
  RawVector<RegionId> region(d.cells.size());
  parallel_fill(std::span(region), RegionId());
  parallel_for(open.size(), grain,
               [&](std::size_t i) { note_least(region[cell_of(open[i].code)].value, open[i].region); });
  const auto first = parallel_select(d.cells.size(), grain, [&](std::size_t cell) { return !region[cell].is_none(); });
  const IndexLists first_of =
      group_indices(plc.regions.size(), first.size(), [&](std::size_t i) { return region[first[i]]; });
  RegionFlood flood(d, bits, region);
  for (std::uint32_t r = 0; r < plc.regions.size(); ++r) {
    std::vector<std::uint32_t> of_region;
    for (const std::uint32_t i : first_of.of(r)) of_region.push_back(first[i]);
    flood.spread(of_region, RegionId(r));
  }
  note_bytes(bytes_of(bits, region, first) + flood.bytes());
  for (const front::FrontFace& face : open)
    if (region[cell_of(face.code)] != face.region) refuse(plc, d, cell_of(face.code));
  // No wall divides the ghosts.
  std::uint32_t ghost = 0;
  while (d.is_dead(ghost) || !d.is_ghost(ghost)) ++ghost;
  if (!region[ghost].is_none()) refuse(plc, d, ghost);
  if (flood.leak() != none) refuse(plc, d, flood.leak());
  return region;
}

}  // namespace ccdt::label
