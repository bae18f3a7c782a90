#include "engine/improve/topological_changes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "engine/base/count_work.h"
#include "engine/improve/crossing_faces.h"
#include "engine/numbers/predicates.h"

namespace ccdt::improve {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The cells around an edge ab between two walls, or all around it: cell i is a, b, vertex i, vertex i + 1.
struct Ring {
  std::uint32_t a, b;
  std::array<std::uint32_t, longest_ring + 1> vertices;
  std::array<std::uint32_t, longest_ring> cells;
  std::uint32_t size = 0;        ///< of the cells
  bool is_closed = false;        ///< the last vertex is the first again
  std::uint32_t begin_wall = 0;  ///< the face code of the wall at vertex 0, in cell 0
  std::uint32_t end_wall = 0;    ///< of the wall at the last vertex, in the last cell

  Ring(std::uint32_t from, std::uint32_t to) : a(from), b(to) {}
  std::uint32_t vertex_count() const { return is_closed ? size : size + 1; }
};

/// Walks around the edge ab from one of its cells, first through the face opposite to `from`, up to a wall.
/// \param visit  called with each cell that is entered and its fourth vertex; false ends the walk
/// \return       the code of the wall that ends the walk, as the cell before it calls it; `no_neighbor`: `visit` did
template <class Visit>
std::uint32_t walk_around(const CellComplex& x, std::uint32_t a, std::uint32_t b, std::uint32_t cell,
                          std::uint32_t from, const Visit& visit) {
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

/// \return false: the ring is too long
bool find_ring(const CellComplex& x, std::uint32_t cell, std::uint32_t before, std::uint32_t after, Ring& ring) {
  ring.size = 1;
  ring.is_closed = false;
  ring.cells[0] = cell;
  ring.vertices[0] = before;
  ring.vertices[1] = after;
  bool fits = true;
  ring.end_wall = walk_around(x, ring.a, ring.b, cell, before, [&](std::uint32_t next, std::uint32_t vertex) {
    ring.is_closed = next == cell;
    fits = ring.size < longest_ring;
    if (ring.is_closed || !fits) return false;
    ring.cells[ring.size++] = next;
    ring.vertices[ring.size] = vertex;
    return true;
  });
  if (ring.is_closed) return true;
  if (!fits) return false;
  // There is a wall: the cells on the other side of the first cell come before it.
  ring.begin_wall = walk_around(x, ring.a, ring.b, cell, after, [&](std::uint32_t next, std::uint32_t vertex) {
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

/// The face with another corner.
FaceChange with_corner(const CellComplex& x, std::uint32_t face, std::uint32_t from, std::uint32_t to) {
  FaceChange change{face, x.faces()[face]};
  std::ranges::replace(change.corners, from, to);
  return change;
}

/// Finds the ring on the other side of the facet where this ring ends, from its last wall to its first.
/// \return false: the cells there do not allow exchanging the diagonal
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
  // At an edge where less than a half turn is inside, the new faces cut off a tetrahedron. At others they add one.
  const bool takes_space =
      other.size == 0 && numbers::orient3d(x.point(a), x.point(b), x.point(first), x.point(last)) < 0;
  if (!takes_space) return true;
  change.space_taken = bounding_box(std::array{x.point(a), x.point(b), x.point(first), x.point(last)});
  return !would_cross(x, change);
}

/// The largest number of cells on one side of the removed faces.
constexpr std::uint32_t most_faces = 6;

/// The faces between two vertices, grown from one of them across its edges, and their edges at the rim.
class SandwichedFaces {
 public:
  SandwichedFaces(const CellComplex& x, std::uint32_t above, std::uint32_t below, double least, Change& change)
      : x_(x), above_(above), below_(below), least_(least), change_(change) {}

  /// Removes a face with the cells on its two sides. Each of its edges is at the rim, or the next face is removed as
  /// well.
  /// \return the quality of the worst new cell; when that is not above `least`, not all of them were made
  double add_face(std::uint32_t upper, std::uint32_t lower, const std::array<std::uint32_t, 3>& corners, int edges) {
    change_.old_cells.push_back(upper);
    change_.old_cells.push_back(lower);
    double worst = infinity;
    for (int i = 0; i < edges && worst > least_; ++i)
      worst = std::min(worst, add_edge(upper, lower, corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]));
    return worst;
  }

 private:
  /// The edge uv of a face whose third corner is w: at the rim, or crossed where that is better.
  double add_edge(std::uint32_t upper, std::uint32_t lower, std::uint32_t u, std::uint32_t v, std::uint32_t w) {
    const std::array<std::uint32_t, 4> rim = {below_, above_, u, v};
    const double at_rim = x_.quality_of(rim);
    const std::size_t olds = change_.old_cells.size(), news = change_.new_cells.size();
    if (at_rim < goal_quality(x_.goal()) && !x_.is_segment(u, v)) {
      const double crossed = cross(upper, lower, u, v, w);
      if (crossed > at_rim) return crossed;
    }
    change_.old_cells.resize(olds);
    change_.new_cells.resize(news);
    change_.new_cells.push_back({rim, x_.region(upper), at_rim});
    return at_rim;
  }

  /// \return the quality that crossing the edge gives; -1 if the next face is not between the same vertices
  double cross(std::uint32_t upper, std::uint32_t lower, std::uint32_t u, std::uint32_t v, std::uint32_t w) {
    if (change_.old_cells.size() >= std::size_t{2} * most_faces) return -1;
    const std::uint32_t up = face_code(upper, x_.place(upper, w)), down = face_code(lower, x_.place(lower, w));
    if (x_.is_wall(up) || x_.is_wall(down)) return -1;
    const std::uint32_t up_code = x_.across(up), down_code = x_.across(down), next = x_.apex_of(up_code);
    const std::uint32_t next_upper = cell_of(up_code), next_lower = cell_of(down_code);
    if (next == below_ || next != x_.apex_of(down_code)) return -1;
    if (x_.is_wall(face_code(next_upper, x_.place(next_upper, above_)))) return -1;
    if (std::ranges::find(change_.old_cells, next_upper) != change_.old_cells.end()) return -1;
    // Only the edges at the corner across are new. The third edge is the one that was crossed.
    return add_face(next_upper, next_lower, {u, next, v}, 2);
  }

  const CellComplex& x_;
  std::uint32_t above_, below_;
  double least_;
  Change& change_;
};

}  // namespace

bool is_new_and_upright(const CellComplex& x, const std::array<std::uint32_t, 3>& corners, std::uint32_t facet) {
  const auto& [a, b, c] = corners;
  return !x.find_face(a, b, c) && facets::is_upright(x.point(a), x.point(b), x.point(c), x.axis_of_facet(facet));
}

double worst_of(const std::vector<NewCell>& cells) {
  double worst = infinity;
  for (const NewCell& cell : cells) worst = std::min(worst, cell.quality);
  return worst;
}

bool plan_edge_removal(const CellComplex& x, std::uint32_t cell, std::uint32_t edge, double least, Change& change) {
  ++work_done.changes_tried;
  change.clear();
  const auto& corner = delaunay::edge_corners[edge];
  const auto& v = x.cell(cell).vertices;
  Ring ring(v[corner[0]], v[corner[1]]);
  if (x.is_segment(ring.a, ring.b) || !find_ring(x, cell, v[corner[2]], v[corner[3]], ring)) return false;
  return ring.is_closed ? add_ring(x, ring, least, change) : plan_flip(x, ring, least, change);
}

bool plan_face_removal(const CellComplex& x, std::uint32_t cell, std::uint32_t face, double least, Change& change) {
  ++work_done.changes_tried;
  change.clear();
  const std::uint32_t code = face_code(cell, face);
  if (x.is_wall(code)) return false;
  const std::uint32_t other = x.across(code);
  SandwichedFaces faces(x, x.apex_of(code), x.apex_of(other), least, change);
  return faces.add_face(cell, cell_of(other), corners_of_face(x.cell(cell).vertices, face), 3) > least;
}

// ---- Insertion and collapse

namespace {

constexpr std::size_t most_cavity_cells = 40;
constexpr int most_insertion_rounds = 3;  ///< of growing the cavity and moving the vertex

/// Finds the hull of the current cavity.
void find_hull(const CellComplex& x, const CellMarks& in_cavity, VertexCavity& cavity) {
  cavity.hull.clear();
  cavity.faces.clear();
  for (const std::uint32_t c : cavity.cells) {
    const Cell& cell = x.cell(c);
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (!x.is_wall(face_code(c, f)) && in_cavity.is_marked(cell_of(cell.neighbors[f]))) continue;
      const auto face = corners_of_face(cell.vertices, f);
      cavity.hull.push_back(face);
      cavity.faces.push_back({x.point(face[0]), x.point(face[1]), x.point(face[2])});
    }
  }
}

/// Adds the cells behind faces that would make a cell worse than `wanted` with the apex. \return false: the cavity has
/// its largest size
bool grow(const CellComplex& x, double wanted, const Point3& apex, CellMarks& in_cavity, VertexCavity& cavity) {
  // Cells that join the cavity are met later in the same loop.
  for (std::size_t i = 0; i < cavity.cells.size(); ++i) {
    const std::uint32_t c = cavity.cells[i];
    const Cell& cell = x.cell(c);
    for (std::uint32_t f = 0; f < 4; ++f) {
      const std::uint32_t next = cell_of(cell.neighbors[f]);
      if (x.is_wall(face_code(c, f)) || in_cavity.is_marked(next)) continue;
      const auto [p, q, r] = corners_of_face(cell.vertices, f);
      if (cell_quality(x.goal(), x.point(p), x.point(q), x.point(r), apex) >= wanted) continue;
      if (cavity.cells.size() >= most_cavity_cells) return false;
      in_cavity.mark(next);
      cavity.cells.push_back(next);
      cavity.tried.push_back(next);
    }
  }
  find_hull(x, in_cavity, cavity);
  return true;
}

Point3 rounded(const Point3& p) {
  return {std::nearbyint(p.x), std::nearbyint(p.y), std::nearbyint(p.z)};
}

/// Are all vertices and edges that must stay on the hull of the cavity?
bool keeps_constraints(const CellComplex& x, const VertexCavity& cavity) {
  const auto on_hull = [&](std::uint32_t a, std::uint32_t b) {
    return std::ranges::any_of(cavity.hull, [&](const auto& face) {
      const auto has = [&](std::uint32_t v) { return std::ranges::find(face, v) != face.end(); };
      return has(a) && has(b);
    });
  };
  for (const std::uint32_t c : cavity.cells) {
    const auto& v = x.cell(c).vertices;
    for (std::uint32_t i = 0; i < 4; ++i) {
      if (!x.is_interior(v[i]) && !on_hull(v[i], v[i])) return false;
      for (std::uint32_t j = i + 1; j < 4; ++j)
        if (x.is_segment(v[i], v[j]) && !on_hull(v[i], v[j])) return false;
    }
  }
  return true;
}

/// The wanted quality of the cells around a new vertex, between that of the cell and the goal.
double wanted_quality(const QualityGoal& goal, double least) {
  return goal.objective == Objective::r ? std::max(least, 0.5 * (std::min(least, goal.inverse_r) + goal.inverse_r))
                                        : 0.5 * (least + goal.sine);
}

/// Makes the cells that remain after `gone` moves onto `end`. \return is each better than `least`?
bool join_star(const CellComplex& x, const std::vector<std::uint32_t>& star, std::uint32_t gone, std::uint32_t end,
               double least, std::vector<NewCell>& made) {
  made.clear();
  for (const std::uint32_t c : star) {
    auto vertices = x.cell(c).vertices;
    if (std::ranges::find(vertices, end) != vertices.end()) continue;
    std::ranges::replace(vertices, gone, end);
    const double quality = x.quality_of(vertices);
    if (!(quality > least)) return false;
    made.push_back({vertices, x.region(c), quality});
  }
  return true;
}

}  // namespace

bool plan_insertion(const CellComplex& x, std::uint32_t cell, double least, PlanScratch& scratch, Change& change) {
  ++work_done.changes_tried;
  auto& [marks, star, joined, cavity, move] = scratch;
  const QualityGoal& goal = x.goal();
  change.clear();
  marks.clear(x.cell_count());
  marks.mark(cell);
  cavity.cells.assign(1, cell);
  cavity.tried.assign(1, cell);
  const auto& v = x.cell(cell).vertices;
  const Point3 origin = x.point(v[0]);
  const Point3 sum = (x.point(v[1]) - origin) + (x.point(v[2]) - origin) + (x.point(v[3]) - origin);
  Point3 apex = rounded(origin + 0.25 * sum);
  double worst = 0;
  for (int round = 0; round < most_insertion_rounds; ++round) {
    const std::size_t size = cavity.cells.size();
    if (!grow(x, wanted_quality(goal, least), apex, marks, cavity)) {
      if (round == 0) return false;
      cavity.cells.resize(size);  // the hull is still theirs
      break;
    }
    worst = worst_of_star(cavity.faces, goal, apex);
    const double before = worst;
    worst = move_apex(cavity.faces, goal, {}, worst, move, apex);
    if (worst == before) break;
  }
  if (!(worst > least) || !keeps_constraints(x, cavity)) return false;
  const auto vertex = static_cast<std::uint32_t>(x.vertex_count());
  const int region = x.region(cell);
  change.new_vertex = apex;
  change.old_cells = cavity.cells;
  for (std::size_t i = 0; i < cavity.hull.size(); ++i) {
    const StarFace& face = cavity.faces[i];
    const auto [a, b, c] = cavity.hull[i];
    change.new_cells.push_back({{a, b, c, vertex}, region, cell_quality(goal, face.a, face.b, face.c, apex)});
  }
  return x.all_positive(change);
}

bool plan_collapse(const CellComplex& x, std::uint32_t cell, double least, PlanScratch& scratch, Change& change) {
  ++work_done.changes_tried;
  bool is_planned = false;
  change.clear();
  const auto corners = x.cell(cell).vertices;
  for (const std::uint32_t gone : corners) {
    if (!x.is_interior(gone)) continue;
    gather_cells(x, gone, scratch.marks, scratch.star);
    for (const std::uint32_t end : corners) {
      if (end == gone || !join_star(x, scratch.star, gone, end, least, scratch.joined)) continue;
      is_planned = true;
      change.old_cells = scratch.star;
      change.new_cells.swap(scratch.joined);
      least = worst_of(change.new_cells);
    }
  }
  return is_planned;
}

}  // namespace ccdt::improve
