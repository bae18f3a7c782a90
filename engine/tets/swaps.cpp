#include "engine/tets/swaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/geometry/predicates.h"
#include "engine/tets/crossing_faces.h"

namespace ccdt::tets {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The cells around an edge ab between two walls, or all around it: cell i is a, b, vertex i, vertex i + 1.
struct Ring {
  std::uint32_t a, b;
  std::array<std::uint32_t, longest_ring + 1> vertices;
  std::array<CellId, longest_ring> cells;
  std::uint32_t size = 0;        ///< of the cells
  bool is_closed = false;        ///< the last vertex is the first again
  std::uint32_t begin_wall = 0;  ///< the face code of the wall at vertex 0, in cell 0
  std::uint32_t end_wall = 0;    ///< of the wall at the last vertex, in the last cell

  Ring(std::uint32_t from, std::uint32_t to) : a(from), b(to) {}
  std::uint32_t vertex_count() const { return is_closed ? size : size + 1; }
};

/// Walks around the edge ab from one of its cells, first through the face opposite `from`, up to a wall.
/// \param visit  called with each cell that is entered and its fourth vertex; false ends the walk
/// \return       the code of the wall that ends the walk, in the cell before it; `no_neighbor` if `visit` ended it
template <class Visit>
std::uint32_t walk_around(const CellComplex& x, std::uint32_t a, std::uint32_t b, CellId cell, std::uint32_t from,
                          const Visit& visit) {
  while (true) {
    const std::uint32_t leaving = face_code(cell, x.place(cell, from));
    if (x.is_wall(leaving)) return leaving;
    const auto& here = x.cell(cell).vertices;
    std::uint32_t shared = 0;
    for (const std::uint32_t v : here)
      if (v != a && v != b && v != from) shared = v;
    const std::uint32_t entered = x.across(leaving);
    cell = cell_of(entered);
    if (!visit(cell, x.apex_of(entered))) return no_neighbor;
    from = shared;
  }
}

/// \return false if the ring is too long
bool find_ring(const CellComplex& x, CellId cell, std::uint32_t before, std::uint32_t after, Ring& ring) {
  ring.size = 1;
  ring.is_closed = false;
  ring.cells[0] = cell;
  ring.vertices[0] = before;
  ring.vertices[1] = after;
  bool fits = true;
  ring.end_wall = walk_around(x, ring.a, ring.b, cell, before, [&](CellId next, std::uint32_t vertex) {
    ring.is_closed = next == cell;
    fits = ring.size < longest_ring;
    if (ring.is_closed || !fits) return false;
    ring.cells[ring.size++] = next;
    ring.vertices[ring.size] = vertex;
    return true;
  });
  if (ring.is_closed) return true;
  if (!fits) return false;
  // There is a wall, so the cells on the other side of the first cell come before it.
  ring.begin_wall = walk_around(x, ring.a, ring.b, cell, after, [&](CellId next, std::uint32_t vertex) {
    fits = ring.size < longest_ring;
    if (!fits) return false;
    std::copy_backward(ring.cells.begin(), ring.cells.begin() + ring.size, ring.cells.begin() + ring.size + 1);
    std::copy_backward(ring.vertices.begin(), ring.vertices.begin() + ring.size + 1,
                       ring.vertices.begin() + ring.size + 2);
    ring.cells[0] = next;
    ring.vertices[0] = vertex;
    ++ring.size;
    return true;
  });
  return fits;
}

/// The best triangulation of the polygon 0 to n - 1 of ring vertices, by dynamic programming over its chords.
class RingTriangulation {
 public:
  RingTriangulation(const CellComplex& x, const Ring& ring, double least) : x_(x), ring_(ring), least_(least) {}

  /// \return the quality of the worst cell, or less than `least` if there is nothing better
  double find() {
    const std::uint32_t n = ring_.vertex_count();
    for (std::uint32_t i = 0; i + 1 < n; ++i) best_[i][i + 1] = infinity;
    for (std::uint32_t span = 2; span < n; ++span)
      for (std::uint32_t i = 0; i + span < n; ++i) find_chord(i, i + span);
    return best_[0][n - 1];
  }

  void add_cells(int region, Change& change) const { add_cells(0, ring_.vertex_count() - 1, region, change); }

 private:
  void find_chord(std::uint32_t i, std::uint32_t j) {
    best_[i][j] = -infinity;
    for (std::uint32_t k = i + 1; k < j; ++k) {
      const double sides = std::min(best_[i][k], best_[k][j]);
      if (sides <= least_ || sides <= best_[i][j]) continue;
      const double all = std::min(sides, quality_of_triangle(i, k, j));
      if (all <= best_[i][j]) continue;
      best_[i][j] = all;
      apex_[i][j] = static_cast<std::uint8_t>(k);
    }
  }

  std::array<std::uint32_t, 4> upper(std::uint32_t i, std::uint32_t k, std::uint32_t j) const {
    return {ring_.vertices[i], ring_.vertices[k], ring_.vertices[j], ring_.b};
  }
  std::array<std::uint32_t, 4> lower(std::uint32_t i, std::uint32_t k, std::uint32_t j) const {
    return {ring_.vertices[i], ring_.vertices[j], ring_.vertices[k], ring_.a};
  }

  double quality_of_triangle(std::uint32_t i, std::uint32_t k, std::uint32_t j) const {
    const double above = x_.quality_of(upper(i, k, j));
    return above <= least_ ? above : std::min(above, x_.quality_of(lower(i, k, j)));
  }

  void add_cells(std::uint32_t i, std::uint32_t j, int region, Change& change) const {
    if (j == i + 1) return;
    const std::uint32_t k = apex_[i][j];
    for (const auto& vertices : {upper(i, k, j), lower(i, k, j)})
      change.new_cells.push_back({vertices, region, x_.quality_of(vertices)});
    add_cells(i, k, region, change);
    add_cells(k, j, region, change);
  }

  const CellComplex& x_;
  const Ring& ring_;
  double least_;
  std::array<std::array<double, longest_ring + 1>, longest_ring + 1> best_;
  std::array<std::array<std::uint8_t, longest_ring + 1>, longest_ring + 1> apex_;
};

/// Adds the best replacement of the cells of a ring, if its quality is greater than `least`.
bool add_ring(const CellComplex& x, const Ring& ring, double least, Change& change) {
  if (ring.vertex_count() < 3) return false;
  RingTriangulation triangulation(x, ring, least);
  if (!(triangulation.find() > least)) return false;
  triangulation.add_cells(x.region(ring.cells[0]), change);
  change.old_cells.insert(change.old_cells.end(), ring.cells.begin(), ring.cells.begin() + ring.size);
  return true;
}

/// The face with one corner replaced by another.
FaceChange with_corner(const CellComplex& x, std::uint32_t face, std::uint32_t from, std::uint32_t to) {
  FaceChange change{face, x.faces()[face]};
  std::ranges::replace(change.corners, from, to);
  return change;
}

/// Finds the ring on the other side of the facet where this ring ends, from its last wall to its first.
/// \return false if the cells there do not allow exchanging the diagonal
bool find_other_side(const CellComplex& x, const Ring& ring, Ring& other) {
  other.size = 0;
  const std::uint32_t behind_begin = x.across(ring.begin_wall), behind_end = x.across(ring.end_wall);
  if (behind_begin == no_neighbor || behind_end == no_neighbor) return behind_begin == behind_end;
  const std::uint32_t first = ring.vertices[ring.size];
  return find_ring(x, cell_of(behind_end), first, x.apex_of(behind_end), other) && !other.is_closed &&
         other.vertices[0] == first && other.vertices[other.size] == ring.vertices[0];
}

/// Plans to flip an edge on a facet: the cells on both sides change, and the facet gets the other diagonal.
bool plan_flip(const CellComplex& x, const Ring& ring, double least, Change& change) {
  const std::uint32_t a = ring.a, b = ring.b, first = ring.vertices[0], last = ring.vertices[ring.size];
  const auto face = x.find_face(a, b, first), next = x.find_face(a, b, last);
  if (!face || !next || x.facet_of_face()[*face] != x.facet_of_face()[*next]) return false;
  Ring other(a, b);
  if (!find_other_side(x, ring, other) || !add_ring(x, ring, least, change)) return false;
  if (other.size > 0 && !add_ring(x, other, least, change)) return false;
  change.faces = {with_corner(x, *face, b, last), with_corner(x, *next, a, first)};
  const std::uint32_t facet = x.facet_of_face()[*face];
  if (!std::ranges::all_of(change.faces, [&](const FaceChange& f) { return is_new_and_upright(x, f.corners, facet); }))
    return false;
  // At an edge with an inner angle below 180 degrees, the new faces cut off a tetrahedron. At others they add one.
  const bool takes_space = other.size == 0 && orient3d(x.point(a), x.point(b), x.point(first), x.point(last)) < 0;
  if (!takes_space) return true;
  change.space_taken = bounding_box(std::array{x.point(a), x.point(b), x.point(first), x.point(last)});
  return !would_cross(x, change);
}

/// The largest number of cells on one side of the removed faces.
constexpr std::uint32_t most_faces = 6;

/// The faces between two vertices, grown from one of the faces across its edges, and their edges at the rim.
class SandwichedFaces {
 public:
  SandwichedFaces(const CellComplex& x, std::uint32_t above, std::uint32_t below, double least, Change& change)
      : x_(x), above_(above), below_(below), least_(least), change_(change) {}

  /// Removes a face with the cells on its two sides. Each of its edges is at the rim, or the next face is removed as
  /// well.
  /// \return the quality of the worst new cell; if it is not above `least`, not all of them were made
  double add_face(CellId upper, CellId lower, const Triangle& corners, int edges) {
    change_.old_cells.push_back(upper);
    change_.old_cells.push_back(lower);
    double worst = infinity;
    for (int i = 0; i < edges && worst > least_; ++i)
      worst = std::min(worst, add_edge(upper, lower, corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]));
    return worst;
  }

 private:
  /// The edge uv of a face whose third corner is w: at the rim, or crossed where that is better.
  double add_edge(CellId upper, CellId lower, std::uint32_t u, std::uint32_t v, std::uint32_t w) {
    const std::array<std::uint32_t, 4> rim = {below_, above_, u, v};
    const double at_rim = x_.quality_of(rim);
    const std::size_t olds = change_.old_cells.size(), news = change_.new_cells.size();
    if (at_rim < x_.goal().good() && !x_.is_segment(u, v)) {
      const double crossed = cross(upper, lower, u, v, w);
      if (crossed > at_rim) return crossed;
    }
    change_.old_cells.resize(olds);
    change_.new_cells.resize(news);
    change_.new_cells.push_back({rim, x_.region(upper), at_rim});
    return at_rim;
  }

  /// \return the quality that results from crossing the edge; -1 if the next face is not between the same vertices
  double cross(CellId upper, CellId lower, std::uint32_t u, std::uint32_t v, std::uint32_t w) {
    if (change_.old_cells.size() >= std::size_t{2} * most_faces) return -1;
    const std::uint32_t up = face_code(upper, x_.place(upper, w)), down = face_code(lower, x_.place(lower, w));
    if (x_.is_wall(up) || x_.is_wall(down)) return -1;
    const std::uint32_t up_code = x_.across(up), down_code = x_.across(down), next = x_.apex_of(up_code);
    const CellId next_upper = cell_of(up_code), next_lower = cell_of(down_code);
    if (next == below_ || next != x_.apex_of(down_code)) return -1;
    if (x_.is_wall(face_code(next_upper, x_.place(next_upper, above_)))) return -1;
    if (has(change_.old_cells, next_upper)) return -1;
    // Only the edges at the opposite corner are new. The third edge is the one that was crossed.
    return add_face(next_upper, next_lower, {u, next, v}, 2);
  }

  const CellComplex& x_;
  std::uint32_t above_, below_;
  double least_;
  Change& change_;
};

}  // namespace

bool is_new_and_upright(const CellComplex& x, const Triangle& corners, std::uint32_t facet) {
  const auto& [a, b, c] = corners;
  return !x.find_face(a, b, c) && facets::is_upright(x.point(a), x.point(b), x.point(c), x.axis_of_facet(facet));
}

double worst_of(const std::vector<NewCell>& cells) {
  double worst = infinity;
  for (const NewCell& cell : cells) worst = std::min(worst, cell.quality);
  return worst;
}

bool plan_edge_removal(const CellComplex& x, CellId cell, std::uint32_t edge, double least, Change& change) {
  ++work_done.changes_tried;
  change.clear();
  const auto& corner = delaunay::edge_corners[edge];
  const auto& v = x.cell(cell).vertices;
  Ring ring(v[corner[0]], v[corner[1]]);
  if (x.is_segment(ring.a, ring.b) || !find_ring(x, cell, v[corner[2]], v[corner[3]], ring)) return false;
  return ring.is_closed ? add_ring(x, ring, least, change) : plan_flip(x, ring, least, change);
}

bool plan_face_removal(const CellComplex& x, CellId cell, std::uint32_t face, double least, Change& change) {
  ++work_done.changes_tried;
  change.clear();
  const std::uint32_t code = face_code(cell, face);
  if (x.is_wall(code)) return false;
  const std::uint32_t other = x.across(code);
  SandwichedFaces faces(x, x.apex_of(code), x.apex_of(other), least, change);
  return faces.add_face(cell, cell_of(other), corners_of_face(x.cell(cell).vertices, face), 3) > least;
}

Swap plan_best_swap(const CellComplex& x, CellId cell, Change& scratch, Change& change) {
  double least = x.quality(cell);
  Box space_taken = empty_box;
  Swap best = Swap::none;
  const auto consider = [&](bool is_better, Swap kind) {
    space_taken = hull(space_taken, scratch.space_taken);
    if (!is_better) return;
    least = worst_of(scratch.new_cells);
    best = kind;
    std::swap(scratch, change);
  };
  for (std::uint32_t edge = 0; edge < 6; ++edge)
    consider(plan_edge_removal(x, cell, edge, least, scratch), Swap::edge_removal);
  for (std::uint32_t face = 0; face < 4; ++face)
    consider(plan_face_removal(x, cell, face, least, scratch), Swap::face_removal);
  change.space_taken = space_taken;
  return best != Swap::none && x.all_positive(change) ? best : Swap::none;
}

}  // namespace ccdt::tets
