#include "engine/tests/improve/improve_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "engine/improve/insert_and_collapse.h"

namespace ccdt::improve_test {
namespace {

using IntegerPoint = std::array<Integer, 3>;

IntegerPoint exact(const Point3& p) {
  const auto integer = [](double x) { return Integer(static_cast<long long>(x)); };
  return {integer(p.x), integer(p.y), integer(p.z)};
}

IntegerPoint difference(const IntegerPoint& a, const IntegerPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

IntegerPoint cross_product(const IntegerPoint& a, const IntegerPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Twice the area of a triangle, as a vector.
IntegerPoint area_vector(const std::vector<Point3>& points, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const IntegerPoint origin = exact(points[a]);
  return cross_product(difference(exact(points[b]), origin), difference(exact(points[c]), origin));
}

Integer sixfold_volume(const std::vector<Point3>& points, const Tetrahedron& t) {
  const IntegerPoint n = area_vector(points, t[0], t[1], t[2]);
  const IntegerPoint d = difference(exact(points[t[3]]), exact(points[t[0]]));
  return n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
}

template <class Visit>
void visit_cells(const tets::CellComplex& x, const Visit& visit) {
  for (CellId c(0); c < x.cell_count(); c = CellId(c + 1))
    if (!x.is_dead(c)) visit(c);
}

FaceKey key_of(const tets::CellComplex& x, std::uint32_t code) {
  const auto& v = x.cell(tets::cell_of(code)).vertices;
  const auto& corner = delaunay::face_corners[delaunay::face_of(code)];
  return face_key(v[corner[0]], v[corner[1]], v[corner[2]]);
}

/// The faces of all cells, by how many cells have them.
std::map<FaceKey, int> count_faces(const std::vector<Tetrahedron>& cells) {
  std::map<FaceKey, int> counts;
  for (const auto& v : cells)
    for (const auto& corner : delaunay::face_corners) ++counts[face_key(v[corner[0]], v[corner[1]], v[corner[2]])];
  return counts;
}

void orient(const std::vector<Point3>& points, Tetrahedron& t) {
  if (sixfold_volume(points, t) < 0) std::swap(t[0], t[1]);
}

/// Gives each face of the boundary that is on no facet one of its own, counterclockwise as seen from outside.
void add_boundary(Model& model) {
  std::set<FaceKey> known;
  for (const Triangle& f : model.faces) known.insert(face_key(f[0], f[1], f[2]));
  const auto counts = count_faces(model.cells);
  std::uint32_t facet = 1000;
  for (const auto& v : model.cells)
    for (const auto& corner : delaunay::face_corners) {
      const Triangle face = {v[corner[0]], v[corner[2]], v[corner[1]]};
      const FaceKey key = face_key(face[0], face[1], face[2]);
      if (counts.at(key) == 2 || !known.insert(key).second) continue;
      model.faces.push_back(face);
      model.facet_of_face.push_back(facet++);
    }
}

void expect_neighbors_fit(const tets::CellComplex& x, std::uint32_t code) {
  const CellId c = tets::cell_of(code);
  const std::uint32_t beyond = x.cell(c).neighbors[delaunay::face_of(code)];
  const FaceKey key = key_of(x, code);
  const bool on_facet = x.find_face(key[0], key[1], key[2]).has_value();
  EXPECT_EQ(x.is_wall(code), on_facet || beyond == delaunay::no_neighbor)
      << "face " << delaunay::face_of(code) << " of cell " << c;
  if (beyond == delaunay::no_neighbor) return;
  ASSERT_LT(tets::cell_of(beyond), x.cell_count());
  EXPECT_FALSE(x.is_dead(tets::cell_of(beyond)));
  EXPECT_EQ(x.cell(tets::cell_of(beyond)).neighbors[delaunay::face_of(beyond)], code);
  EXPECT_EQ(key_of(x, beyond), key_of(x, code));
  EXPECT_TRUE(x.is_wall(code) || x.region(tets::cell_of(beyond)) == x.region(c)) << "cell " << c;
}

void expect_vertices_know_cells(const tets::CellComplex& x) {
  std::vector<bool> in_use(x.vertex_count(), false);
  visit_cells(x, [&](CellId c) {
    for (const std::uint32_t v : x.cell(c).vertices) in_use[v] = true;
  });
  for (std::uint32_t v = 0; v < x.vertex_count(); ++v) {
    const CellId c = x.cell_at(v);
    EXPECT_EQ(!c.is_none(), in_use[v]) << "vertex " << v;
    if (c.is_none()) continue;
    ASSERT_FALSE(x.is_dead(c)) << "vertex " << v;
    EXPECT_EQ(std::ranges::count(x.cell(c).vertices, v), 1) << "vertex " << v;
  }
}

void expect_faces_and_segments_there(const tets::CellComplex& x) {
  std::set<FaceKey> faces;
  std::set<std::uint64_t> edges;
  visit_cells(x, [&](CellId c) {
    const auto& v = x.cell(c).vertices;
    for (std::uint32_t f = 0; f < 4; ++f) faces.insert(key_of(x, delaunay::face_code(c, f)));
    for (std::uint32_t i = 0; i < 4; ++i)
      for (std::uint32_t j = 0; j < i; ++j) edges.insert(edge_key(v[i], v[j]));
  });
  for (std::uint32_t f = 0; f < x.faces().size(); ++f) {
    if (x.faces()[f] == tets::no_corners) continue;
    const FaceKey key = face_key(x.faces()[f][0], x.faces()[f][1], x.faces()[f][2]);
    EXPECT_TRUE(faces.contains(key)) << "face " << f;
    EXPECT_EQ(x.find_face(key[0], key[1], key[2]), f);
  }
  x.segments().for_each([&](std::uint64_t key, NoValue) {
    EXPECT_TRUE(edges.contains(key)) << "segment " << (key >> 32) << " " << (key & 0xFFFFFFFFu);
  });
}

/// Makes a planned change in a copy.
void expect_sound(tets::CellComplex x, const Invariants& before, double least, const tets::Change& change,
                  PlanCounts& counts) {
  EXPECT_GT(tets::worst_of(change.new_cells), least);
  if (!x.all_positive(change)) return;  // such a plan is given up
  const std::uint64_t changes = x.change_count();
  const auto places = apply_change(x, change);
  EXPECT_GT(x.change_count(), changes);
  EXPECT_EQ(places.size(), change.new_cells.size());
  for (const tets::NewCell& made : change.new_cells) EXPECT_EQ(made.quality, x.quality_of(made.vertices));
  expect_consistent(x);
  EXPECT_TRUE(invariants_of(x) == before);
  for (std::uint32_t v = 0; v < x.vertex_count(); ++v)
    if (x.cell_at(v).is_none()) counts.vertices_gone.insert(v);
}

}  // namespace

std::vector<Point3> points_of(const tets::CellComplex& x) {
  std::vector<Point3> points;
  for (std::uint32_t v = 0; v < x.vertex_count(); ++v) points.push_back(x.point(v));
  return points;
}

std::vector<CellId> apply_change(tets::CellComplex& x, tets::Change change) {
  std::vector<CellId> made;
  x.apply(change, made);
  return made;
}

LargeVector<delaunay::Cell> unjoined_cells(const mesh::TetMesh& mesh) {
  LargeVector<delaunay::Cell> cells;
  for (const Tetrahedron& t : mesh.tetrahedra) cells.push_back({t, {none, none, none, none}});
  return cells;
}

tets::CellComplex complex_of(Model model, const tets::QualityGoal& goal) {
  for (Tetrahedron& t : model.cells) orient(model.points, t);
  add_boundary(model);
  mesh::TetMesh mesh;
  mesh.tetrahedra = model.cells;
  model.regions.resize(model.cells.size(), 0);
  const auto first_interior = std::min(model.first_interior, static_cast<std::uint32_t>(model.points.size()));
  return tets::CellComplex(model.faces, model.segments, unjoined_cells(mesh), model.regions, model.points,
                           model.facet_of_face, first_interior, goal);
}

Invariants invariants_of(const tets::CellComplex& x) {
  Invariants result;
  const std::vector<Point3> points = points_of(x);
  visit_cells(x, [&](CellId c) {
    result.sixfold_volumes[x.region(c)] += sixfold_volume(points, x.cell(c).vertices);
    for (const std::uint32_t v : x.cell(c).vertices) {
      if (x.is_interior(v)) continue;
      result.kept_vertices.insert(v);
      result.places[v] = as_array(x.point(v));
    }
  });
  for (std::size_t f = 0; f < x.faces().size(); ++f) {
    if (x.faces()[f] == tets::no_corners) continue;
    const IntegerPoint area = area_vector(points, x.faces()[f][0], x.faces()[f][1], x.faces()[f][2]);
    auto& sum = result.twofold_area_vectors[x.facet_of_face()[f]];
    for (std::size_t i = 0; i < 3; ++i) sum[i] += area[i];
    ++result.face_counts[x.facet_of_face()[f]];
  }
  return result;
}

void expect_consistent(const tets::CellComplex& x) {
  std::size_t dead = 0;
  const std::vector<Point3> points = points_of(x);
  for (CellId c(0); c < x.cell_count(); c = CellId(c + 1)) {
    dead += x.is_dead(c);
    if (x.is_dead(c)) continue;
    EXPECT_GT(sixfold_volume(points, x.cell(c).vertices), 0) << "cell " << c;
    EXPECT_EQ(x.quality(c), x.quality_of(x.cell(c).vertices)) << "cell " << c;
    for (std::uint32_t f = 0; f < 4; ++f) expect_neighbors_fit(x, delaunay::face_code(c, f));
  }
  EXPECT_EQ(dead, x.dead_count());
  expect_vertices_know_cells(x);
  expect_faces_and_segments_there(x);
}

PlanCounts expect_every_plan_is_sound(const tets::CellComplex& complex) {
  PlanCounts counts;
  const Invariants before = invariants_of(complex);
  const tets::CellComplex& x = complex;
  tets::Change change;
  improve::PlanScratch scratch;
  const auto make = [&](int& count, CellId cell) {
    ++count;
    expect_sound(x, before, x.quality(cell), change, counts);
  };
  visit_cells(complex, [&](CellId c) {
    SCOPED_TRACE("cell " + std::to_string(c));
    const double least = complex.quality(c);
    for (std::uint32_t edge = 0; edge < 6; ++edge) {
      if (!tets::plan_edge_removal(x, c, edge, least, change)) continue;
      counts.facet_flips += change.faces.empty() ? 0 : 1;
      make(counts.edge_removals, c);
    }
    for (std::uint32_t face = 0; face < 4; ++face)
      if (tets::plan_face_removal(x, c, face, least, change)) make(counts.face_removals, c);
    if (improve::plan_collapse(x, c, least, scratch, change)) make(counts.collapses, c);
    if (improve::plan_insertion(x, c, least, scratch, change)) make(counts.insertions, c);
  });
  return counts;
}

double worst_quality(const tets::CellComplex& x) {
  double worst = 2;
  visit_cells(x, [&](CellId c) { worst = std::min(worst, x.quality(c)); });
  return worst;
}

std::set<Tetrahedron> cells_of(const tets::CellComplex& x) {
  std::set<Tetrahedron> cells;
  visit_cells(x, [&](CellId c) {
    Tetrahedron t = x.cell(c).vertices;
    std::ranges::sort(t);
    cells.insert(t);
  });
  return cells;
}

std::uint32_t edge_of_cell(const tets::CellComplex& x, CellId cell, std::uint32_t a, std::uint32_t b) {
  const auto& v = x.cell(cell).vertices;
  std::uint32_t edge = 0;
  while (edge < 6 && edge_key(v[delaunay::edge_corners[edge][0]], v[delaunay::edge_corners[edge][1]]) != edge_key(a, b))
    ++edge;
  return edge;
}

bool has_edge(const tets::CellComplex& x, std::uint32_t a, std::uint32_t b) {
  return std::ranges::any_of(cells_of(x), [&](const Tetrahedron& t) {
    return std::ranges::count(t, a) == 1 && std::ranges::count(t, b) == 1;
  });
}

}  // namespace ccdt::improve_test
