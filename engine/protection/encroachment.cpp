#include "engine/protection/encroachment.h"

#include <algorithm>
#include <array>

#include "engine/base/count_work.h"
#include "engine/geometry/predicates.h"

namespace ccdt::protection {
namespace {

/// With more vertices, finding the cavity of a probe is cheaper.
constexpr std::size_t most_vertices = 16;

}  // namespace

// The points that see the piece at one angle form a circular arc between its ends, rotated around it. The middle of the
// arc is farthest away.
double WorstVertex::width() const {
  return 0.5 * std::sqrt(squared_length(b_ - a_) * (1 + least_cosine_ + 1e-9) / (1 - least_cosine_));
}

/// From every vertex but the nearest one, an edge leads to a vertex nearer to a given place, as in a greedy walk. So
/// the vertices in a ball are connected by edges within it, and the cells around them by faces that have such a vertex.
///
/// A piece that is not an edge leaves its first end through a cell that has another vertex in the diametral ball, or on
/// it: the power of a point with respect to this ball, less that with respect to the cell's sphere, changes linearly.
/// It is zero at the first end and at most zero at the other. So it is at most zero where the piece leaves the cell,
/// and hence at one of the three corners around that place, which are on the cell's sphere. If a vertex of that cell is
/// clearly inside, the search starts there and does not go through the ends.
///
/// If many vertices are in the diametral ball, one worse than the worst so far can only be near the piece. It is
/// searched for in the ball between itself and one of three vertices: the worst so far or an end, whichever is nearest
/// along the piece. A vertex may be in such a ball if some place near that part of the piece is in front of the plane
/// through it.
bool DiametralSearch::find_worst(std::uint32_t a, std::uint32_t b, WorstVertex& worst) {
  const Point3 &p = d_.point(a), &q = d_.point(b);
  const double length = ccdt::length(q - p), room = 1e-9 * length * length;
  const auto is_within = [&](std::uint32_t v, double bound) { return dot(p - d_.point(v), q - d_.point(v)) < bound; };
  const std::uint32_t leaving = cell_toward(d_, a, q, b);
  const bool starts_inside =
      std::ranges::any_of(d_.cells[leaving].vertices, [&](std::uint32_t v) { return is_within(v, -room); });
  if (spread(leaving, worst,
             [&](std::uint32_t v) { return is_within(v, room) && (!starts_inside || (v != a && v != b)); }))
    return true;
  const double width = worst.width();
  if (width > 0.1 * length) return false;
  const Point3 axis = (1 / length) * (q - p);
  const std::uint32_t worst_so_far = *worst.vertex();
  const double before = 0.5 * dot(axis, d_.point(worst_so_far) - p), after = 0.5 * length - before;
  const auto search_from = [&](std::uint32_t start, double backward, double forward) {
    return spread(cell_at(start), worst, [&](std::uint32_t v) {
      const Point3 to = d_.point(v) - d_.point(start);
      const double along = dot(axis, to), across = ccdt::length(cross(axis, to));
      return (std::max(-along * backward, along * forward) + 2 * width * across) * (1 + 1e-9) >= squared_length(to);
    });
  };
  return search_from(a, 0, before) && search_from(worst_so_far, before, after) && search_from(b, after, 0);
}

/// A cell with this vertex.
std::uint32_t DiametralSearch::cell_at(std::uint32_t v) const {
  const std::uint32_t cell = d_.cell_at[v];
  return d_.is_ghost(cell) ? delaunay::cell_of(d_.cells[cell].neighbors[3]) : cell;
}

/// Examines those vertices inside that edges within connect to vertices of the first cell.
/// \return false if there are too many
template <class IsInside>
bool DiametralSearch::spread(std::uint32_t first, WorstVertex& worst, const IsInside& is_inside) {
  is_found_.resize(d_.cells.size(), 0);
  where_.resize(d_.vertices.size(), Where::unknown);
  const delaunay::Cell* const cells = d_.cells.data();
  std::uint8_t* const is_found = is_found_.data();
  Where* const where = where_.data();
  std::size_t found = 0;
  const auto is_known_inside = [&](std::uint32_t v) {
    if (where[v] == Where::unknown) {
      const bool inside = is_inside(v);
      where[v] = inside ? Where::inside : Where::outside;
      met_.push_back(v);
      if (inside) ++found, worst.examine(v, d_.point(v));
    }
    return where[v] == Where::inside;
  };
  met_.clear();
  cells_.assign(1, first);
  is_found[first] = 1;
  for (std::size_t i = 0; i < cells_.size() && found <= most_vertices; ++i) {
    const auto& [v, neighbors] = cells[cells_[i]];
    const std::array inside = {is_known_inside(v[0]), is_known_inside(v[1]), is_known_inside(v[2]),
                               is_known_inside(v[3])};
    const int count = inside[0] + inside[1] + inside[2] + inside[3];
    for (int f = 0; f < 4; ++f) {
      const std::uint32_t next = delaunay::cell_of(neighbors[f]);
      if (count == inside[f] || is_found[next] != 0 || cells[next].vertices[3] == delaunay::ghost_vertex) continue;
      is_found[next] = 1;
      cells_.push_back(next);
    }
  }
  work_done.cells_visited += cells_.size();
  for (const std::uint32_t cell : cells_) is_found[cell] = 0;
  for (const std::uint32_t v : met_) where[v] = Where::unknown;
  return found <= most_vertices;
}

/// The new edge would be in the cavity, which is star-shaped around p: so the cell through which it leaves v is in the
/// cavity.
bool would_be_joined(const delaunay::Delaunay& d, std::uint32_t v, const Point3& p) {
  const auto& corners = d.cells[cell_toward(d, v, p)].vertices;
  return insphere(d.point(corners[0]), d.point(corners[1]), d.point(corners[2]), d.point(corners[3]), p) > 0;
}

}  // namespace ccdt::protection
