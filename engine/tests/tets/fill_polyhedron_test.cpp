#include "engine/tets/fill_polyhedron.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "engine/geometry/predicates.h"
#include "engine/plc/build_plc.h"
#include "engine/tests/improve/improve_checks.h"
#include "engine/tests/shared/plc_test_solids.h"

namespace ccdt {
namespace {

using namespace improve_test;

/// A polyhedron, and its tetrahedra around one more vertex, the last.
Model model_of(const plc::InputPlc& input) {
  const plc::Plc plc = plc::build_plc(input);
  Model model;
  model.points = plc.vertices;
  Point3 middle{};
  for (const Point3& p : plc.vertices) middle = middle + (1.0 / static_cast<double>(plc.vertices.size())) * p;
  const auto center = static_cast<std::uint32_t>(model.points.size());
  model.points.push_back({std::round(middle.x), std::round(middle.y), std::round(middle.z)});
  for (const auto& [a, b, c] : plc.triangles) model.cells.push_back({a, b, c, center});
  return model;
}

/// The faces of the cells opposite to the last vertex, the inside above.
std::vector<Triangle> hull_of(const tets::CellComplex& x) {
  std::vector<Triangle> hull;
  const auto center = static_cast<std::uint32_t>(x.vertex_count() - 1);
  for (CellId c(0); c < x.cell_count(); c = CellId(c + 1))
    hull.push_back(tets::corners_of_face(x.cell(c).vertices, x.place(c, center)));
  return hull;
}

Integer sixfold_volume(const tets::CellComplex& x, const Tetrahedron& t) {
  std::array<std::array<Integer, 3>, 3> m;
  const Point3& a = x.point(t[0]);
  for (int i = 0; i < 3; ++i) {
    const Point3 edge = x.point(t[i + 1]) - a;
    m[i] = {Integer(edge.x), Integer(edge.y), Integer(edge.z)};
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// Fills the polyhedron without its last vertex. \return was it filled?
bool fills(const Model& model) {
  const tets::CellComplex x = complex_of(model, {tets::Objective::r, 1, 1});
  tets::PolyhedronFiller filler;
  std::vector<tets::NewCell> cells;
  const bool is_filled = filler.fill(x, hull_of(x), 7, 0, cells);
  EXPECT_EQ(is_filled, !cells.empty());
  if (!is_filled) return false;
  Integer before = 0, after = 0;
  for (CellId c(0); c < x.cell_count(); c = CellId(c + 1)) before += sixfold_volume(x, x.cell(c).vertices);
  std::map<FaceKey, int> counts;
  for (const tets::NewCell& cell : cells) {
    EXPECT_GT(sixfold_volume(x, cell.vertices), 0);
    EXPECT_EQ(cell.region, 7);
    after += sixfold_volume(x, cell.vertices);
    for (std::uint32_t f = 0; f < 4; ++f) {
      const auto [a, b, c] = tets::corners_of_face(cell.vertices, f);
      ++counts[face_key(a, b, c)];
    }
  }
  EXPECT_EQ(before, after);
  for (const auto& [a, b, c] : hull_of(x)) EXPECT_EQ(counts[face_key(a, b, c)], 1);
  return true;
}

TEST(PolyhedronFiller, FillsACube) {
  EXPECT_TRUE(fills(model_of(plc_test::box({0, 0, 0}, {3, 3, 3}))));
}

/// An octahedron around the last vertex, with the other vertices on the axes, and its axis along x short.
Model octahedron() {
  Model model;
  model.points = {{-3, 0, 0}, {3, 0, 0}, {0, -9, 0}, {0, 9, 0}, {0, 0, -9}, {0, 0, 9}, {0, 0, 0}};
  for (const std::uint32_t a : {0u, 1u})
    for (const std::uint32_t b : {2u, 3u})
      for (const std::uint32_t c : {4u, 5u}) model.cells.push_back({a, b, c, 6});
  return model;
}

bool has_all(const tets::NewCell& cell, std::initializer_list<std::uint32_t> vertices) {
  return std::ranges::all_of(
      vertices, [&](std::uint32_t v) { return std::ranges::find(cell.vertices, v) != cell.vertices.end(); });
}

TEST(PolyhedronFiller, JoinsAllFacesToTheVertexWithTheBestTetrahedra) {
  const tets::CellComplex x = complex_of(octahedron(), {tets::Objective::r, 1, 1});
  tets::PolyhedronFiller filler;
  std::vector<tets::NewCell> cells;
  ASSERT_TRUE(filler.fill(x, hull_of(x), 7, 0, cells));
  ASSERT_EQ(cells.size(), 4u);
  for (const tets::NewCell& cell : cells) EXPECT_TRUE(has_all(cell, {0, 1}));
}

TEST(PolyhedronFiller, KeepsAFacetThatEndsInside) {
  const tets::CellComplex x = complex_of(octahedron(), {tets::Objective::r, 1, 1});
  std::vector<Triangle> hull = hull_of(x);
  hull.push_back({0, 2, 6});
  hull.push_back({0, 6, 2});
  tets::PolyhedronFiller filler;
  std::vector<tets::NewCell> cells;
  ASSERT_TRUE(filler.fill(x, hull, 7, 0, cells));
  EXPECT_EQ(std::ranges::count_if(cells, [](const auto& cell) { return has_all(cell, {0, 2, 6}); }), 2);
}

TEST(PolyhedronFiller, FindsThatSchoenhardtsPolyhedronCannotBeFilled) {
  EXPECT_FALSE(fills(model_of(plc_test::schoenhardt())));
}

/// A triangulated sphere around the origin whose vertices are at random distances from it.
Model random_star(std::mt19937& random) {
  std::uniform_real_distribution<double> distance(300, 1000);
  Model model;
  constexpr std::uint32_t meridians = 5, parallels = 3;
  const auto add = [&](double polar, double azimuth) {
    const double r = distance(random), across = r * std::sin(polar);
    model.points.push_back({std::round(across * std::cos(azimuth)), std::round(across * std::sin(azimuth)),
                            std::round(r * std::cos(polar))});
  };
  const double pi = std::acos(-1.0);
  add(0, 0), add(pi, 0);
  for (std::uint32_t i = 1; i <= parallels; ++i)
    for (std::uint32_t j = 0; j < meridians; ++j) add(pi * i / (parallels + 1), 2 * pi * j / meridians);
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return 2 + i * meridians + j % meridians; };
  const auto center = static_cast<std::uint32_t>(model.points.size());
  model.points.push_back({0, 0, 0});
  for (std::uint32_t j = 0; j < meridians; ++j) {
    model.cells.push_back({0, at(0, j), at(0, j + 1), center});
    model.cells.push_back({1, at(parallels - 1, j), at(parallels - 1, j + 1), center});
    for (std::uint32_t i = 0; i + 1 < parallels; ++i) {
      model.cells.push_back({at(i, j), at(i, j + 1), at(i + 1, j), center});
      model.cells.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j), center});
    }
  }
  return model;
}

TEST(PolyhedronFiller, FillsMostRandomStars) {
  std::mt19937 random(1);
  int filled = 0;
  for (int i = 0; i < 200; ++i) filled += fills(random_star(random));
  EXPECT_GT(filled, 150);
}

/// The least quality over all faces of the best tetrahedron on the face.
double best_on_worst_face(const tets::CellComplex& x) {
  double least = 1;
  for (const auto& [a, b, c] : hull_of(x)) {
    double best = 0;
    for (std::uint32_t v = 0; v + 1 < x.vertex_count(); ++v)
      if (v != a && v != b && v != c) best = std::max(best, x.quality_of({a, b, c, v}));
    least = std::min(least, best);
  }
  return least;
}

// With its corners in another order, the same tetrahedron may look better because of rounding.
TEST(PolyhedronFiller, DoesNotTakeARoundingForAnImprovement) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const tets::CellComplex x = complex_of(random_star(random), {tets::Objective::r, 1, 1});
    tets::PolyhedronFiller filler;
    std::vector<tets::NewCell> cells;
    EXPECT_FALSE(filler.fill(x, hull_of(x), 7, best_on_worst_face(x), cells));
  }
}

}  // namespace
}  // namespace ccdt
