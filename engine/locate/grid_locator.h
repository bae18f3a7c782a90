#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/base/index.h"
#include "engine/base/index_lists.h"
#include "engine/base/uniform_grid.h"
#include "engine/delaunay/delaunay.h"
#include "engine/locate/cap.h"

namespace ccdt::locate {

/// Finds vertices near a face and PLC faces near an edge by a uniform grid (paper, section 4). It works well for even
/// density.
class GridLocator {
 public:
  /// \param scale  factor of the paper's cell size
  GridLocator(std::span<const delaunay::DelaunayVertex> vertices, std::span<const std::array<VertexId, 3>> faces,
              double scale = 1);

  std::size_t bytes() const { return bytes_of(vertices_, first_vertex_, faces_.first, faces_.items); }

  /// Calls visit(vertex) once for every vertex that the cap may contain, and for some others, by increasing distance
  /// from `start`, one ring of cells after another. The cap may shrink during the search.
  template <class Visit>
  void visit_nearest_first(const Point3& start, const Cap& cap, const Visit& visit) const;

  /// Calls visit(face) for every face that the straight edge from p to q may meet, some more than once, until it
  /// returns true. \return did a call?
  template <class Visit>
  bool any_near_edge(const Point3& p, const Point3& q, const Visit& visit) const;

  /// The same for every face that may meet the box.
  template <class Visit>
  bool any_near_box(const Box& box, const Visit& visit) const;

 private:
  template <class Visit>
  void visit_ring(const UniformGrid::CellIndex& middle, int ring, const Cap& cap, const Visit& visit) const;
  template <class Visit>
  void visit_cell(const UniformGrid::CellIndex& cell, const Cap& cap, const Visit& visit) const;
  template <class Visit>
  bool any_in_cells(const UniformGrid::CellIndex& from, const UniformGrid::CellIndex& to, const Visit& visit) const;

  UniformGrid grid_;
  std::vector<LocatedVertex> vertices_;      // by cell
  std::vector<std::uint32_t> first_vertex_;  // of each cell, and one more
  IndexLists faces_;
};

template <class Visit>
void GridLocator::visit_nearest_first(const Point3& start, const Cap& cap, const Visit& visit) const {
  const UniformGrid::CellIndex middle = grid_.cell_at(start);
  int rings = 0;
  for (int i = 0; i < 3; ++i) rings = std::max({rings, middle[i], grid_.cells[i] - 1 - middle[i]});
  for (int ring = 0; ring <= rings; ++ring) {
    const double farthest = std::sqrt(squared_length(cap.center() - start)) + cap.radius();
    if ((ring - 1) * grid_.cell_size > farthest) return;
    visit_ring(middle, ring, cap, visit);
  }
}

template <class Visit>
void GridLocator::visit_ring(const UniformGrid::CellIndex& middle, int ring, const Cap& cap, const Visit& visit) const {
  const Point3 r{cap.radius(), cap.radius(), cap.radius()};
  UniformGrid::CellIndex from = grid_.cell_at(cap.center() - r), to = grid_.cell_at(cap.center() + r);
  for (int i = 0; i < 3; ++i) {
    from[i] = std::max(from[i], middle[i] - ring);
    to[i] = std::min(to[i], middle[i] + ring);
  }
  for (int z = from[2]; z <= to[2]; ++z) {
    for (int y = from[1]; y <= to[1]; ++y) {
      // Within a row only the two ends are on the ring, unless the whole row is.
      const bool whole = std::abs(z - middle[2]) == ring || std::abs(y - middle[1]) == ring;
      const int step = whole ? 1 : std::max(1, 2 * ring);
      for (int x = whole ? from[0] : middle[0] - ring; x <= to[0]; x += step)
        if (x >= from[0]) visit_cell({x, y, z}, cap, visit);
    }
  }
}

template <class Visit>
void GridLocator::visit_cell(const UniformGrid::CellIndex& cell, const Cap& cap, const Visit& visit) const {
  ++work_done.grid_cells;
  const std::size_t number = grid_.number(cell);
  const std::uint32_t first = first_vertex_[number], last = first_vertex_[number + 1];
  if (first == last) return;
  if (cap.misses(grid_.box(cell))) return;
  for (std::uint32_t i = first; i < last; ++i) visit(vertices_[i]);
}

template <class Visit>
bool GridLocator::any_near_edge(const Point3& p, const Point3& q, const Visit& visit) const {
  // The edge is visited in pieces about as long as a cell, each in a box of a few cells, slightly widened to cover
  // rounding.
  const double length = std::sqrt(squared_length(q - p));
  const int pieces = std::max(1, static_cast<int>(length / grid_.cell_size));
  const double slack = 1e-3 * grid_.cell_size;
  UniformGrid::CellIndex last_from{-1, -1, -1}, last_to = last_from;
  for (int i = 0; i < pieces; ++i) {
    const Point3 a = p + (static_cast<double>(i) / pieces) * (q - p),
                 b = p + (static_cast<double>(i + 1) / pieces) * (q - p);
    const Box box = expanded(hull(box_of(a), box_of(b)), slack);
    const UniformGrid::CellIndex from = grid_.cell_at(box.low), to = grid_.cell_at(box.high);
    if (from == last_from && to == last_to) continue;
    last_from = from, last_to = to;
    if (any_in_cells(from, to, visit)) return true;
  }
  return false;
}

template <class Visit>
bool GridLocator::any_near_box(const Box& box, const Visit& visit) const {
  const Box wider = expanded(box, 1e-3 * grid_.cell_size);
  return any_in_cells(grid_.cell_at(wider.low), grid_.cell_at(wider.high), visit);
}

template <class Visit>
bool GridLocator::any_in_cells(const UniformGrid::CellIndex& from, const UniformGrid::CellIndex& to,
                               const Visit& visit) const {
  for (int z = from[2]; z <= to[2]; ++z)
    for (int y = from[1]; y <= to[1]; ++y)
      for (int x = from[0]; x <= to[0]; ++x) {
        ++work_done.grid_cells;
        for (const std::uint32_t f : faces_.of(grid_.number({x, y, z})))
          if (visit(f)) return true;
      }
  return false;
}

}  // namespace ccdt::locate
