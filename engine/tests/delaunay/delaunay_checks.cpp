#include "engine/tests/delaunay/delaunay_checks.h"

#include <algorithm>
#include <utility>

#include "engine/geometry/predicates.h"

namespace ccdt::test {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

/// Is e in the perturbed sphere of the positively oriented v?
bool in_sphere(std::span<const delaunay::DelaunayVertex> vertices, const Corners& v, std::uint32_t e) {
  const delaunay::DelaunayVertex &a = vertices[v[0]], &b = vertices[v[1]], &c = vertices[v[2]], &d = vertices[v[3]];
  return insphere_perturbed(a.point, b.point, c.point, d.point, vertices[e].point,
                            {a.rank, b.rank, c.rank, d.rank, vertices[e].rank}) > 0;
}

/// Is e beyond the hull face of a ghost or, in its plane, in its perturbed circle?
bool in_ghost(const delaunay::Delaunay& d, const delaunay::Cell& ghost, std::uint32_t e) {
  const delaunay::DelaunayVertex &a = d.vertices[ghost.vertices[0]], &b = d.vertices[ghost.vertices[1]],
                                 &c = d.vertices[ghost.vertices[2]];
  const int side = orient3d(a.point, b.point, c.point, d.point(e));
  if (side != 0) return side > 0;
  const std::uint32_t inner = ghost.neighbors[3];
  const Point3& apex = d.point(d.cells[delaunay::cell_of(inner)].vertices[delaunay::face_of(inner)]);
  return incircle_perturbed(a.point, c.point, b.point, apex, d.point(e), {a.rank, c.rank, b.rank, d.vertices[e].rank}) >
         0;
}

std::array<std::uint32_t, 3> corners_of_face(const delaunay::Cell& cell, std::uint32_t f) {
  const auto& corner = delaunay::face_corners[f];
  return {cell.vertices[corner[0]], cell.vertices[corner[1]], cell.vertices[corner[2]]};
}

/// Does the one triangle have the corners of the other, passed in the opposite direction?
bool are_opposite(const std::array<std::uint32_t, 3>& f, const std::array<std::uint32_t, 3>& g) {
  for (int shift = 0; shift < 3; ++shift)
    if (f[0] == g[shift] && f[1] == g[(shift + 2) % 3] && f[2] == g[(shift + 1) % 3]) return true;
  return false;
}

AssertionResult has_good_vertices(const delaunay::Delaunay& d, std::uint32_t c) {
  const auto& v = d.cells[c].vertices;
  for (int i = 0; i < 4; ++i) {
    if (v[i] == delaunay::ghost_vertex ? i != 3 : v[i] >= d.vertices.size())
      return AssertionFailure() << "cell " << c << " has a wrong vertex " << i;
    for (int j = 0; j < i; ++j)
      if (v[i] == v[j]) return AssertionFailure() << "cell " << c << " has a vertex twice";
  }
  if (v[3] != delaunay::ghost_vertex && orient3d(d.point(v[0]), d.point(v[1]), d.point(v[2]), d.point(v[3])) <= 0)
    return AssertionFailure() << "cell " << c << " is not positively oriented";
  return AssertionSuccess();
}

AssertionResult has_good_neighbors(const delaunay::Delaunay& d, std::uint32_t c) {
  for (std::uint32_t f = 0; f < 4; ++f) {
    const std::uint32_t code = d.cells[c].neighbors[f];
    if (delaunay::cell_of(code) >= d.cells.size() || d.is_dead(delaunay::cell_of(code)))
      return AssertionFailure() << "cell " << c << " has no neighbor across face " << f;
    const delaunay::Cell& other = d.cells[delaunay::cell_of(code)];
    if (other.neighbors[delaunay::face_of(code)] != delaunay::face_code(c, f))
      return AssertionFailure() << "cell " << c << " is not the neighbor of its neighbor across face " << f;
    if (!are_opposite(corners_of_face(d.cells[c], f), corners_of_face(other, delaunay::face_of(code))))
      return AssertionFailure() << "cell " << c << " and its neighbor name different faces across face " << f;
  }
  return AssertionSuccess();
}

AssertionResult has_empty_sphere(const delaunay::Delaunay& d, std::uint32_t c) {
  const delaunay::Cell& cell = d.cells[c];
  for (std::uint32_t e = 0; e < d.vertices.size(); ++e) {
    if (std::find(cell.vertices.begin(), cell.vertices.end(), e) != cell.vertices.end()) continue;
    if (d.is_ghost(c) ? in_ghost(d, cell, e) : in_sphere(d.vertices, cell.vertices, e))
      return AssertionFailure() << "vertex " << e << " is in the sphere of cell " << c;
  }
  return AssertionSuccess();
}

AssertionResult has_good_hint(const delaunay::Delaunay& d, std::uint32_t v) {
  const std::uint32_t c = d.cell_at[v];
  if (c >= d.cells.size() || d.is_dead(c)) return AssertionFailure() << "vertex " << v << " names no living cell";
  const auto& corners = d.cells[c].vertices;
  if (std::find(corners.begin(), corners.end(), v) == corners.end())
    return AssertionFailure() << "vertex " << v << " names a cell without it";
  return AssertionSuccess();
}

}  // namespace

std::vector<Corners> sorted_cells(const delaunay::Delaunay& d) {
  std::vector<Corners> cells;
  for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
    if (!d.is_finite(c)) continue;
    cells.push_back(d.cells[c].vertices);
    std::sort(cells.back().begin(), cells.back().end());
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

std::vector<Corners> cells_by_definition(std::span<const delaunay::DelaunayVertex> vertices) {
  const auto n = static_cast<std::uint32_t>(vertices.size());
  std::vector<Corners> cells;
  const auto add_if_empty = [&](const Corners& corners) {
    Corners v = corners;
    const int side = orient3d(vertices[v[0]].point, vertices[v[1]].point, vertices[v[2]].point, vertices[v[3]].point);
    if (side == 0) return;
    if (side < 0) std::swap(v[0], v[1]);
    for (std::uint32_t e = 0; e < n; ++e)
      if (std::find(v.begin(), v.end(), e) == v.end() && in_sphere(vertices, v, e)) return;
    cells.push_back(corners);
  };
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = a + 1; b < n; ++b)
      for (std::uint32_t c = b + 1; c < n; ++c)
        for (std::uint32_t e = c + 1; e < n; ++e) add_if_empty({a, b, c, e});
  return cells;
}

AssertionResult is_consistent(const delaunay::Delaunay& d) {
  const std::set<std::uint32_t> free(d.free_cells.begin(), d.free_cells.end());
  if (free.size() != d.free_cells.size()) return AssertionFailure() << "a free cell is listed twice";
  for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
    if (d.is_dead(c) != free.contains(c)) return AssertionFailure() << "cell " << c << " is dead or free, not both";
    if (d.is_dead(c)) continue;
    if (const auto good = has_good_vertices(d, c); !good) return good;
    if (const auto good = has_good_neighbors(d, c); !good) return good;
  }
  std::set<std::uint32_t> ranks;
  for (std::uint32_t v = 0; v < d.vertices.size(); ++v) {
    if (const auto good = has_good_hint(d, v); !good) return good;
    if (!ranks.insert(d.vertices[v].rank).second) return AssertionFailure() << "vertex " << v << " shares its rank";
  }
  return AssertionSuccess();
}

AssertionResult has_empty_spheres(const delaunay::Delaunay& d) {
  for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
    if (d.is_dead(c)) continue;
    if (const auto empty = has_empty_sphere(d, c); !empty) return empty;
  }
  return AssertionSuccess();
}

AssertionResult are_equal(const delaunay::Delaunay& a, const delaunay::Delaunay& b) {
  const auto same_vertex = [](const delaunay::DelaunayVertex& v, const delaunay::DelaunayVertex& w) {
    return v.point == w.point && v.rank == w.rank;
  };
  const auto same_cell = [](const delaunay::Cell& c, const delaunay::Cell& e) {
    return c.vertices == e.vertices && c.neighbors == e.neighbors;
  };
  if (!std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), b.vertices.end(), same_vertex))
    return AssertionFailure() << "the vertices differ";
  if (a.cell_at != b.cell_at) return AssertionFailure() << "the cells at vertices differ";
  if (!std::equal(a.cells.begin(), a.cells.end(), b.cells.begin(), b.cells.end(), same_cell))
    return AssertionFailure() << "the cells differ";
  if (a.free_cells != b.free_cells) return AssertionFailure() << "the free cells differ";
  return AssertionSuccess();
}

}  // namespace ccdt::test
