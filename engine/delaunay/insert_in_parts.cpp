#include "engine/delaunay/insert_in_parts.h"

#include <algorithm>
#include <array>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/sort_in_runs.h"

namespace ccdt::delaunay {
namespace {

/// In parts with fewer vertices, too many are near the border.
constexpr std::size_t least_part = 250;
/// Another pass pays off if there is more than one waiting vertex per this many cells.
constexpr std::size_t cells_per_waiting_vertex = 2000;
/// The normals of the planes of each pass. The vertices that wait are near the planes of the previous pass; only a few
/// of them are near planes in very different directions.
constexpr std::array<Basis, 3> bases = {{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                         {{{2, 2, 1}, {-2, 1, 2}, {1, -2, 2}}},
                                         {{{6, 2, 3}, {-3, 6, 2}, {-2, -3, 6}}}}};
constexpr std::size_t sample_size = 4096;
/// A part rarely needs more than this many cells per new vertex; if it does, the rest of the part waits.
constexpr std::size_t most_cells_per_vertex = 8;
/// A part takes a chunk of places at a time: a sixteenth of what it may need, but at most a large page. If chunks were
/// small, several threads would use a new page at the same time, and the system would clear one for each of them.
constexpr std::size_t chunks_per_part = 16, least_chunk = 512, most_chunk = 65536;
constexpr std::size_t report_every = 4096;

std::size_t chunk_of(std::size_t vertices, std::size_t parts) {
  return std::clamp(most_cells_per_vertex * vertices / (parts * chunks_per_part), least_chunk, most_chunk);
}

}  // namespace

PartedInsertion::PartedInsertion(Delaunay& d, InsertionMarks& marks) : d_(d), part_(d.vertices.size()), marks_(marks) {
  marks_.local.resize(d.vertices.size(), InsertionMarks::no_local);
  marks_.in_cavity.reserve(d.cells.capacity());
}

std::vector<std::uint32_t> PartedInsertion::insert(std::span<const std::uint32_t> vertices,
                                                   std::vector<std::uint32_t> waiting, std::size_t done,
                                                   std::size_t total, const Progress& progress) {
  SharedProgress shared(progress, "delaunay", done, total);
  std::span<const std::uint32_t> those = vertices;
  for (std::size_t p = 0; p < bases.size(); ++p) {
    const std::size_t parts = std::min<std::size_t>(thread_count(), those.size() / least_part);
    if (p == 0 && parts < 2) waiting.insert(waiting.end(), vertices.begin(), vertices.end());
    if (parts < 2 || (p > 0 && those.size() < d_.cells.size() / cells_per_waiting_vertex)) break;
    cut(those, static_cast<std::uint32_t>(parts), bases[p]);
    const auto left = pass(those, p, shared);
    if (p > 0) waiting.clear();
    waiting.insert(waiting.end(), left.begin(), left.end());
    those = waiting;
  }
  return waiting;
}

std::size_t PartedInsertion::most_cells(std::size_t vertices) {
  // The cells of the inserted vertices, and room for those of the few that wait.
  return (most_cells_per_vertex + 1) * vertices + 4 * thread_count() * chunk_of(vertices, thread_count());
}

void PartedInsertion::cut(std::span<const std::uint32_t> vertices, std::uint32_t parts, const Basis& basis) {
  std::vector<Point3> sample;
  for (std::size_t i = 0; i < vertices.size(); i += vertices.size() / sample_size + 1)
    sample.push_back(d_.point(vertices[i]));
  const SpaceCut space(sample, parts, basis);
  start_ = std::vector<std::atomic<std::uint32_t>>(parts);
  for (auto& start : start_) start = none;
  // A walk that starts in a shared cell may get nowhere.
  const auto is_whole = [&](std::uint32_t cell, std::uint32_t part) {
    return std::ranges::all_of(d_.cells[cell].vertices, [&](std::uint32_t v) {
      return v == ghost_vertex || space.part_of(d_.point(v)) == part;
    });
  };
  parallel_for(vertices.back() + 1, 4096, [&](std::size_t v) {
    const std::uint32_t part = space.part_of(d_.point(static_cast<std::uint32_t>(v))), cell = d_.cell_at[v];
    part_[v] = static_cast<Part>(part);
    if (cell != none && start_[part].load(std::memory_order_relaxed) == none && is_whole(cell, part))
      start_[part].store(cell, std::memory_order_relaxed);
  });
}

/// Marks for all cells.
void PartedInsertion::add_marks() {
  const std::size_t old = std::min(marks_.in_cavity.size(), d_.cells.size());
  marks_.in_cavity.resize(d_.cells.size());
  parallel_fill(std::span(marks_.in_cavity).subspan(old), std::uint8_t{0});
}

std::vector<std::uint32_t> PartedInsertion::pass(std::span<const std::uint32_t> vertices, std::size_t number,
                                                 SharedProgress& progress) {
  const std::size_t old = d_.cells.size(), parts = start_.size(), chunk = chunk_of(vertices.size(), parts);
  const std::size_t room = (most_cells_per_vertex * vertices.size() / chunk + 2 * parts) * chunk;
  d_.cells.resize(old + room);
  add_marks();
  CellPool pool{static_cast<std::uint32_t>(chunk), static_cast<std::uint32_t>(old + room),
                static_cast<std::uint32_t>(old)};
  const std::vector<std::uint32_t> free = std::move(d_.free_cells);
  d_.free_cells.clear();
  done_parts_ = 0;
  std::vector<std::vector<std::uint32_t>> waiting_of(parts);
  parallel_for(parts, 1, [&](std::size_t part) {
    const std::size_t begin = free.size() * part / parts, end = free.size() * (part + 1) / parts;
    waiting_of[part] = insert_part(static_cast<Part>(part), vertices, number, pool,
                                   std::span(free).subspan(begin, end - begin), progress);
  });
  d_.cells.resize(std::min(pool.next.load(), pool.end));
  note_bytes(
      bytes_of(vertices, d_.vertices, d_.cell_at, d_.cells, d_.free_cells, part_, marks_.in_cavity, marks_.local));
  std::vector<std::uint32_t> waiting;
  for (const auto& of_one : waiting_of) waiting.insert(waiting.end(), of_one.begin(), of_one.end());
  sort_in_runs(waiting);
  return waiting;
}

std::vector<std::uint32_t> PartedInsertion::insert_part(Part part, std::span<const std::uint32_t> vertices,
                                                        std::size_t number, CellPool& pool,
                                                        std::span<const std::uint32_t> free, SharedProgress& progress) {
  Insertion insertion(d_, marks_, {part_, part}, pool, free);
  std::vector<std::uint32_t> waiting = insert_in_order(insertion, part, vertices, number, progress);
  for (const std::uint32_t c : insertion.free_places()) d_.cells[c] = {{}, {no_neighbor}};
  const std::lock_guard lock(mutex_);
  d_.free_cells.insert(d_.free_cells.end(), insertion.free_places().begin(), insertion.free_places().end());
  return waiting;
}

std::vector<std::uint32_t> PartedInsertion::insert_in_order(Insertion& insertion, Part part,
                                                            std::span<const std::uint32_t> vertices, std::size_t number,
                                                            SharedProgress& progress) {
  std::uint32_t last = start_[part];
  const Ties ties = number == 0 ? Ties::greatest_rank : Ties::any_rank;
  // Parts do not all take the same time. When half of them are done, the next pass divides what is left of the others.
  // A part that begins only then, because no thread was free earlier, is not stopped.
  const auto are_half_done = [&] { return 2 * done_parts_.load(std::memory_order_relaxed) >= start_.size(); };
  const bool may_stop = number + 1 < bases.size() && !are_half_done();
  std::vector<std::uint32_t> waiting;
  std::size_t tried = 0;
  bool is_stopped = last == none;
  for (const std::uint32_t v : vertices) {
    if (part_[v] != part) continue;
    is_stopped = is_stopped || (may_stop && are_half_done());
    if (is_stopped) {
      waiting.push_back(v);
      continue;
    }
    if (++tried % report_every == 0 && !progress.add(report_every)) break;
    if (insertion.find_cavity(v, insertion.cell_near(v, last), ties) && insertion.has_room()) {
      last = insertion.fill_cavity();
    } else {
      insertion.discard_cavity();
      last = insertion.reached();
      waiting.push_back(v);
    }
  }
  // A part may also be done early because many of its vertices wait.
  if (4 * waiting.size() < tried) ++done_parts_;
  return waiting;
}

}  // namespace ccdt::delaunay
