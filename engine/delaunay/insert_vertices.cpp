#include "engine/delaunay/insert_vertices.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/delaunay/hilbert_order.h"
#include "engine/delaunay/insert_in_parts.h"
#include "engine/delaunay/insertion.h"

namespace ccdt::delaunay {
namespace {

/// Inserts vertices one after another.
/// \param done, total  what to report of the whole stage
void insert_in_order(Delaunay& d, InsertionMarks& marks, std::span<const std::uint32_t> vertices, Ties ties,
                     std::size_t done, std::size_t total, const Progress& progress) {
  Insertion insertion(d, marks);
  std::uint32_t last = d.cell_at[0];
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    insertion.find_cavity(vertices[i], insertion.cell_near(vertices[i], last), ties);
    last = insertion.fill_cavity();
    if ((i & 0xFFFF) == 0) report(progress, "delaunay", done + i, total);
  }
  note_bytes(bytes_of(vertices, d.vertices, d.cell_at, d.cells, d.free_cells) + insertion.bytes());
}

/// About how many cells there are per vertex, ghosts included. Points of a lattice add 6 cells each, or a few more.
constexpr double cells_per_vertex = 6.25;
constexpr std::size_t cells_per_surface_vertex = 9;  ///< if all vertices are on surfaces
/// With fewer vertices, several threads gain nothing.
constexpr std::size_t least_for_threads = 5000;
/// One thread inserts the first vertices, at least this many.
constexpr std::size_t least_first = 100;
/// Each round on all threads multiplies the number of vertices by this.
constexpr std::size_t growth = 8;

bool are_several_worth_it(std::size_t vertices) {
  return thread_count() > 1 && vertices >= least_for_threads;
}

}  // namespace

void reserve_cells(Delaunay& d, std::size_t capacity) {
  if (d.cells.capacity() >= capacity) return;
  LargeVector<Cell> moved;
  moved.reserve(capacity);
  moved.resize(d.cells.size());
  parallel_for(d.cells.size(), 4096, [&](std::size_t c) { moved[c] = d.cells[c]; });
  d.cells.swap(moved);
}

std::size_t most_new_cells(std::size_t vertices) {
  if (are_several_worth_it(vertices)) return PartedInsertion::most_cells(vertices);
  return static_cast<std::size_t>(cells_per_vertex * static_cast<double>(vertices)) + 64;
}

void insert_vertices(Delaunay& d, std::span<const std::uint32_t> vertices, const Progress& progress) {
  reserve_cells(d,
                std::max(d.cells.size() + most_new_cells(vertices.size()), cells_per_surface_vertex * vertices.size()));
  InsertionMarks marks;
  if (!are_several_worth_it(vertices.size())) {
    insert_in_order(d, marks, vertices, Ties::greatest_rank, 0, vertices.size(), progress);
    return;
  }
  // These are about the rounds of `hilbert_order`: each round adds points everywhere between those of the round before.
  // The surface's vertices do not count: the cells between these cross the whole inside, so all would wait.
  std::size_t first = vertices.size();
  while (first >= growth * least_first) first /= growth;
  insert_in_order(d, marks, vertices.first(first), Ties::greatest_rank, 0, vertices.size(), progress);
  PartedInsertion parted(d, marks);
  std::vector<std::uint32_t> waiting;
  for (std::size_t begin = first, end = 0; begin < vertices.size(); begin = end) {
    end = 2 * growth * begin < vertices.size() ? growth * begin : vertices.size();
    waiting = parted.insert(vertices.subspan(begin, end - begin), std::move(waiting), begin, vertices.size(), progress);
    if (waiting.size() < (end - begin) / 4) continue;
    // Without them, the cells would be too large in the next round.
    insert_in_order(d, marks, waiting, Ties::any_rank, end - waiting.size(), vertices.size(), progress);
    waiting.clear();
  }
  insert_in_order(d, marks, waiting, Ties::any_rank, vertices.size() - waiting.size(), vertices.size(), progress);
}

std::vector<std::uint32_t> append_vertices(Delaunay& d, std::span<const Point3> points,
                                           std::span<const std::uint8_t> later_rounds) {
  std::vector<std::uint32_t> order = hilbert_order(points, later_rounds);
  const std::size_t first = d.vertices.size();
  d.vertices.resize(first + points.size());
  d.cell_at.resize(first + points.size());
  parallel_for(points.size(), 4096, [&](std::size_t i) {
    d.vertices[first + i] = {points[order[i]], static_cast<std::uint32_t>(first + i)};
    d.cell_at[first + i] = none;
  });
  return order;
}

void insert_points(Delaunay& d, std::span<const Point3> points, std::span<const std::uint8_t> later_rounds,
                   const Progress& progress) {
  const auto first = static_cast<std::uint32_t>(d.vertices.size());
  append_vertices(d, points, later_rounds);
  std::vector<std::uint32_t> added(points.size());
  std::iota(added.begin(), added.end(), first);
  insert_vertices(d, added, progress);
}

}  // namespace ccdt::delaunay
