#include "engine/delaunay/delaunay.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/base/platform.h"
#include "engine/delaunay/hilbert_order.h"
#include "engine/delaunay/insert_vertices.h"
#include "engine/geometry/predicates.h"

namespace ccdt::delaunay {
namespace {

/// Puts four points that are not in one plane first in `order`, positively oriented.
void put_simplex_first(std::span<const Point3> points, std::vector<std::uint32_t>& order) {
  const auto bring = [&](std::size_t to, auto&& good) {
    for (std::size_t i = to; i < order.size(); ++i) {
      if (good(points[order[i]])) {
        std::rotate(order.begin() + static_cast<std::ptrdiff_t>(to), order.begin() + static_cast<std::ptrdiff_t>(i),
                    order.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        return;
      }
    }
    refuse_flat_points();
  };
  const auto at = [&](std::size_t i) -> const Point3& { return points[order[i]]; };
  bring(0, [](const Point3&) { return true; });
  bring(1, [&](const Point3& p) { return !(p == at(0)); });
  bring(2, [&](const Point3& p) { return !collinear(at(0), at(1), p); });
  bring(3, [&](const Point3& p) { return orient3d(at(0), at(1), at(2), p) != 0; });
  if (orient3d(at(0), at(1), at(2), at(3)) < 0) std::swap(order[0], order[1]);
}

/// The indices of the points in the order of insertion.
std::vector<std::uint32_t> insertion_order(std::span<const Point3> points, std::span<const std::uint32_t> first = {}) {
  std::vector<std::uint32_t> order = hilbert_order(points);
  if (!first.empty()) {
    std::vector<bool> is_first(points.size(), false);
    for (const std::uint32_t i : first) is_first[i] = true;
    std::erase_if(order, [&](std::uint32_t i) { return is_first[i]; });
    order.insert(order.begin(), first.begin(), first.end());
  }
  put_simplex_first(points, order);
  return order;
}

/// The tetrahedron of vertices 0 to 3 with its four ghosts.
void make_first_cells(Delaunay& d) {
  d.cells.assign(5, {});
  work_done.cells_created += 5;
  d.cells[0].vertices = {0, 1, 2, 3};
  for (const std::uint32_t v : d.cells[0].vertices) d.cell_at[v] = 0;
  for (std::uint32_t f = 0; f < 4; ++f) {
    // From outside, the face is seen with the opposite orientation.
    const auto& corner = face_corners[f];
    d.cells[f + 1].vertices = {corner[0], corner[2], corner[1], ghost_vertex};
    d.cells[f + 1].neighbors[3] = face_code(0, f);
    d.cells[0].neighbors[f] = face_code(f + 1, 3);
  }
  // Two ghosts share the face that has neither of their opposite vertices.
  for (std::uint32_t i = 1; i < 5; ++i) {
    for (std::uint32_t f = 0; f < 3; ++f) {
      const std::uint32_t other = 1 + d.cells[i].vertices[f];  // the ghost over the face opposite this vertex
      const auto& v = d.cells[other].vertices;
      const auto g = static_cast<std::uint32_t>(std::find(v.begin(), v.end(), i - 1) - v.begin());
      d.cells[i].neighbors[f] = face_code(other, g);
    }
  }
}

/// Converts places in the insertion order back to ids.
void renumber(Delaunay& d, const std::vector<std::uint32_t>& order) {
  DelaunayVertices by_id(order.size());
  RawVector<std::uint32_t> cell_at(order.size());
  parallel_for(order.size(), 4096,
               [&](std::size_t i) { by_id[order[i]] = d.vertices[i], cell_at[order[i]] = d.cell_at[i]; });
  d.vertices = std::move(by_id);
  d.cell_at = std::move(cell_at);
  parallel_for(d.cells.size(), 4096, [&](std::size_t c) {
    for (std::uint32_t& v : d.cells[c].vertices)
      if (v != ghost_vertex) v = order[v];
  });
}

}  // namespace

void refuse_flat_points() {
  throw MeshError("there are fewer than four vertices, or all are in one plane", {},
                  "a tetrahedral mesh needs a body: check that the input is not flat");
}

std::vector<std::uint32_t> insertion_ranks(std::span<const Point3> points) {
  const std::vector<std::uint32_t> order = insertion_order(points);
  std::vector<std::uint32_t> ranks(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) ranks[order[i]] = static_cast<std::uint32_t>(i);
  return ranks;
}

Delaunay build_delaunay(std::span<const Point3> points, const Progress& progress,
                        std::span<const std::uint32_t> first) {
  const std::vector<std::uint32_t> order = insertion_order(points, first);
  Delaunay d;
  d.vertices.resize(points.size());
  d.cell_at.resize(points.size());
  parallel_for(order.size(), 4096, [&](std::size_t i) {
    d.vertices[i] = {points[order[i]], static_cast<std::uint32_t>(i)};
    d.cell_at[i] = none;
  });
  // The orientation of the first tetrahedron may have swapped the first two.
  if (!first.empty() && order[0] != first[0]) std::swap(d.vertices[0].rank, d.vertices[1].rank);
  make_first_cells(d);
  std::vector<std::uint32_t> others(d.vertices.size() - 4);
  std::iota(others.begin(), others.end(), 4u);
  insert_vertices(d, others, progress);
  renumber(d, order);
  return d;
}

std::span<const std::uint32_t> CellStar::around(std::uint32_t vertex) {
  seen_.resize(d_.cells.size(), search_);
  if (++search_ == 0) {
    std::fill(seen_.begin(), seen_.end(), 0);
    search_ = 1;
  }
  cells_.assign(1, d_.cell_at[vertex]);
  seen_[cells_[0]] = search_;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = d_.cells[cells_[i]];
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (cell.vertices[f] == vertex) continue;
      const std::uint32_t next = cell_of(cell.neighbors[f]);
      if (seen_[next] == search_) continue;
      seen_[next] = search_;
      cells_.push_back(next);
      prefetch(&d_.cells[next]);
    }
  }
  work_done.cells_visited += cells_.size();
  return cells_;
}

// A walk within the star of a. Like any walk toward a point in a Delaunay tetrahedralization, it terminates.
std::uint32_t cell_toward(const Delaunay& d, std::uint32_t a, const Point3& p, std::uint32_t b) {
  std::uint32_t here = d.cell_at[a];
  // The walk never leaves the hull, because p is inside.
  if (d.is_ghost(here)) here = cell_of(d.cells[here].neighbors[3]);
  for (std::uint32_t from = no_neighbor;;) {
    ++work_done.cells_visited;
    const Cell& cell = d.cells[here];
    if (place_of(cell, b) < 4) return here;
    std::uint32_t exit = 4;
    for (std::uint32_t f = 0; f < 4 && exit == 4; ++f) {
      if (cell.vertices[f] == a || cell.neighbors[f] == from) continue;
      const auto [u, v, w] = corners_of_face(cell.vertices, f);
      if (orient3d(d.point(u), d.point(v), d.point(w), p) < 0) exit = f;
    }
    if (exit == 4) return here;
    from = face_code(here, exit);
    here = cell_of(cell.neighbors[exit]);
  }
}

std::vector<Point3> points_of(const Delaunay& d) {
  std::vector<Point3> points;
  points.reserve(d.vertices.size());
  for (const DelaunayVertex& v : d.vertices) points.push_back(v.point);
  return points;
}

// If ab is an edge, the cell toward b has it.
std::uint32_t find_edge(const Delaunay& d, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t cell = cell_toward(d, a, d.point(b), b);
  return place_of(d.cells[cell], b) < 4 ? cell : no_neighbor;
}

std::uint32_t find_face(const Delaunay& d, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t at_edge) {
  std::uint32_t found = no_neighbor;
  if (at_edge == no_neighbor) return found;
  walk_around_edge(d, a, b, at_edge, [&](std::uint32_t here, std::uint32_t exit, std::uint32_t staying) {
    ++work_done.cells_visited;
    const Cell& cell = d.cells[here];
    if (cell.vertices[staying] != c) return true;
    const std::uint32_t i = place_of(cell, a), j = place_of(cell, b);
    const auto& corner = face_corners[exit];
    const bool above =
        (corner[0] == i && corner[1] == j) || (corner[1] == i && corner[2] == j) || (corner[2] == i && corner[0] == j);
    found = above ? face_code(here, exit) : cell.neighbors[exit];
    return false;
  });
  return found;
}

}  // namespace ccdt::delaunay
