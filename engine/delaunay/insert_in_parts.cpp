#include "engine/delaunay/insert_in_parts.h"

#include <algorithm>
#include <array>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"

namespace ccdt::delaunay {
namespace {

/// In smaller parts, too many vertices are near the border.
constexpr std::size_t least_part = 250;
/// Another pass pays off if more than one vertex waits for every this many cells.
constexpr std::size_t cells_per_waiting_vertex = 2000;
/// The normals of the planes of each pass. The vertices that wait are near the planes of the pass before; only few of
/// them are near planes in very different directions.
constexpr std::array<Basis, 3> bases = {{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                         {{{2, 2, 1}, {-2, 1, 2}, {1, -2, 2}}},
                                         {{{6, 2, 3}, {-3, 6, 2}, {-2, -3, 6}}}}};
constexpr std::size_t sample_size = 4096;
/// More than this many cells per new vertex are rare; then the rest of a part waits.
constexpr std::size_t most_cells_of_vertex = 8;
constexpr std::size_t report_every = 4096;

}  // namespace

PartedInsertion::PartedInsertion(Delaunay& d) : d_(d), part_(d.vertices.size()) {
  marks_.local.resize(d.vertices.size(), InsertionMarks::no_local);
}

std::vector<std::uint32_t> PartedInsertion::insert(std::span<const std::uint32_t> vertices,
                                                   std::vector<std::uint32_t> waiting, std::size_t done,
                                                   std::size_t total, const Progress& progress) {
  SharedProgress shared(progress, "delaunay", done, total);
  waiting.insert(waiting.end(), vertices.begin(), vertices.end());
  std::size_t with_lower_rank = waiting.size() - vertices.size();
  for (std::size_t p = 0; p < bases.size(); ++p) {
    const auto those = std::span(waiting).subspan(with_lower_rank);
    const std::size_t parts = std::min<std::size_t>(thread_count(), those.size() / least_part);
    if (parts < 2 || (p > 0 && those.size() < d_.cells.size() / cells_per_waiting_vertex)) break;
    cut(those, static_cast<std::uint32_t>(parts), bases[p]);
    const auto left = pass(those, p, shared);
    waiting.resize(with_lower_rank);
    waiting.insert(waiting.end(), left.begin(), left.end());
    with_lower_rank = 0;
  }
  return waiting;
}

std::size_t PartedInsertion::most_cells(std::size_t vertices) {
  // Those of the vertices that are in, and room for those that wait, which are few.
  return (most_cells_of_vertex + 1) * vertices + 4 * thread_count() * CellPool::chunk;
}

void PartedInsertion::cut(std::span<const std::uint32_t> vertices, std::uint32_t parts, const Basis& basis) {
  std::vector<Point3> sample;
  for (std::size_t i = 0; i < vertices.size(); i += vertices.size() / sample_size + 1)
    sample.push_back(d_.point(vertices[i]));
  const SpaceCut space(sample, parts, basis);
  start_ = std::vector<std::atomic<std::uint32_t>>(parts);
  for (auto& start : start_) start = no_cell;
  // From a shared cell, a walk may not get anywhere.
  const auto is_whole = [&](std::uint32_t cell, std::uint32_t part) {
    return std::ranges::all_of(d_.cells[cell].vertices, [&](std::uint32_t v) {
      return v == ghost_vertex || space.part_of(d_.point(v)) == part;
    });
  };
  parallel_for(vertices.back() + 1, 4096, [&](std::size_t v) {
    const std::uint32_t part = space.part_of(d_.point(static_cast<std::uint32_t>(v))), cell = d_.cell_at[v];
    part_[v] = static_cast<Part>(part);
    if (cell != no_cell && start_[part].load(std::memory_order_relaxed) == no_cell && is_whole(cell, part))
      start_[part].store(cell, std::memory_order_relaxed);
  });
}

std::vector<std::uint32_t> PartedInsertion::pass(std::span<const std::uint32_t> vertices, std::size_t number,
                                                 SharedProgress& progress) {
  std::vector<std::vector<std::uint32_t>> of_part(start_.size());
  for (const std::uint32_t v : vertices) of_part[part_[v]].push_back(v);
  const std::size_t old = d_.cells.size(), chunk = CellPool::chunk;
  const std::size_t room = (most_cells_of_vertex * vertices.size() / chunk + 2 * start_.size()) * chunk;
  d_.cells.resize(old + room);
  marks_.in_cavity.resize(old + room, 0);
  CellPool pool{static_cast<std::uint32_t>(old), static_cast<std::uint32_t>(old + room)};
  done_parts_ = 0;
  parallel_for(start_.size(), 1, [&](std::size_t part) {
    of_part[part] = insert_part(static_cast<Part>(part), of_part[part], number, pool, progress);
  });
  d_.cells.resize(std::min(pool.next.load(), pool.end));
  for (const std::uint32_t c : unused_) {
    d_.cells[c] = {{}, {no_neighbor}};
    d_.free_cells.push_back(c);
  }
  unused_.clear();
  note_bytes(
      bytes_of(vertices, d_.vertices, d_.cell_at, d_.cells, d_.free_cells, part_, marks_.in_cavity, marks_.local));
  std::vector<std::uint32_t> waiting;
  for (const auto& of_one : of_part) waiting.insert(waiting.end(), of_one.begin(), of_one.end());
  std::ranges::sort(waiting);
  return waiting;
}

/// \return  the vertices that wait
std::vector<std::uint32_t> PartedInsertion::insert_part(Part part, std::span<const std::uint32_t> vertices,
                                                        std::size_t number, CellPool& pool, SharedProgress& progress) {
  std::uint32_t last = start_[part];
  if (last == no_cell) return {vertices.begin(), vertices.end()};
  Insertion insertion(d_, marks_, {part_, part}, pool);
  const Ties ties = number == 0 ? Ties::greatest_rank : Ties::any_rank;
  // Parts do not take the same time. When half of them are done, the next pass divides what is left of the others. A
  // part that begins only then, because no thread was free before, is not stopped.
  const auto are_half_done = [&] { return 2 * done_parts_.load(std::memory_order_relaxed) >= start_.size(); };
  const bool may_stop = number + 1 < bases.size() && !are_half_done();
  std::vector<std::uint32_t> waiting;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (may_stop && are_half_done()) {
      waiting.insert(waiting.end(), vertices.begin() + static_cast<std::ptrdiff_t>(i), vertices.end());
      break;
    }
    if (i % report_every == report_every - 1 && !progress.add(report_every)) break;
    if (insertion.find_cavity(vertices[i], last, ties) && insertion.has_room()) {
      last = insertion.fill_cavity();
    } else {
      insertion.discard_cavity();
      last = insertion.reached();
      waiting.push_back(vertices[i]);
    }
  }
  // A part may also be done early because many of its vertices wait.
  if (4 * waiting.size() < vertices.size()) ++done_parts_;
  const std::lock_guard lock(mutex_);
  unused_.insert(unused_.end(), insertion.unused_places().begin(), insertion.unused_places().end());
  return waiting;
}

}  // namespace ccdt::delaunay
