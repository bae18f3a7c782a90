#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/hilbert_order.h"
#include "engine/delaunay/insertion.h"
#include "engine/geometry/predicates.h"
#include "engine/tests/delaunay/delaunay_checks.h"
#include "engine/tests/delaunay/delaunay_point_sets.h"

namespace ccdt {
namespace {

using namespace test;

bool has_vertex(const delaunay::Cell& cell, std::uint32_t v) {
  return std::find(cell.vertices.begin(), cell.vertices.end(), v) != cell.vertices.end();
}

/// All cells that are not dead and have all of the vertices.
std::set<std::uint32_t> cells_with(const delaunay::Delaunay& d, const std::vector<std::uint32_t>& vertices) {
  std::set<std::uint32_t> cells;
  for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
    const auto has = [&](std::uint32_t v) { return has_vertex(d.cells[c], v); };
    if (!d.is_dead(c) && std::all_of(vertices.begin(), vertices.end(), has)) cells.insert(c);
  }
  return cells;
}

/// The code is that of the face abc in the cell that sees abc counterclockwise; a ghost is outside the hull.
void expect_face_above(const delaunay::Delaunay& d, std::uint32_t code, std::uint32_t a, std::uint32_t b,
                       std::uint32_t c) {
  const delaunay::Cell& cell = d.cells[delaunay::cell_of(code)];
  const std::uint32_t apex = cell.vertices[delaunay::face_of(code)];
  EXPECT_TRUE(has_vertex(cell, a) && has_vertex(cell, b) && has_vertex(cell, c));
  EXPECT_TRUE(apex != a && apex != b && apex != c);
  if (apex != delaunay::ghost_vertex) {
    EXPECT_GT(orient3d(d.point(a), d.point(b), d.point(c), d.point(apex)), 0);
  } else {
    const std::uint32_t inner = cell.neighbors[delaunay::face_of(code)];
    const Point3& below = d.point(d.cells[delaunay::cell_of(inner)].vertices[delaunay::face_of(inner)]);
    EXPECT_LT(orient3d(d.point(a), d.point(b), d.point(c), below), 0);
  }
}

/// Tetrahedralizations after building alone, and after insertions that reuse cells.
std::vector<delaunay::Delaunay> samples() {
  std::vector<delaunay::Delaunay> result;
  for (const NamedPoints& set : tiny_sets()) {
    result.push_back(delaunay::build_delaunay(set.points));
    if (set.points.size() < 16) continue;
    delaunay::Delaunay d = delaunay::build_delaunay(std::span(set.points).first(set.points.size() / 2));
    delaunay::Insertion insertion(d);
    for (std::size_t i = d.vertices.size(); i < set.points.size(); ++i) {
      insertion.find_cavity(d.add_vertex(set.points[i]), d.cell_at[0]);
      insertion.fill_cavity();
    }
    result.push_back(std::move(d));
  }
  return result;
}

TEST(CellStar, HoldsAllCellsAroundAVertexOnce) {
  for (const delaunay::Delaunay& d : samples()) {
    delaunay::CellStar star(d);
    for (std::uint32_t v = 0; v < d.vertices.size(); ++v) {
      const auto around = star.around(v);
      const std::set<std::uint32_t> cells(around.begin(), around.end());
      EXPECT_EQ(cells.size(), around.size());
      EXPECT_EQ(cells, cells_with(d, {v}));
    }
  }
}

TEST(Delaunay, KnowsAllEdges) {
  for (const delaunay::Delaunay& d : samples()) {
    for (std::uint32_t a = 0; a < d.vertices.size(); ++a)
      for (std::uint32_t b = a + 1; b < d.vertices.size(); ++b)
        ASSERT_EQ(has_edge(d, a, b), !cells_with(d, {a, b}).empty()) << a << " " << b;
  }
}

TEST(FindFace, FindsAllFacesFromBothSidesAndNoOthers) {
  for (const delaunay::Delaunay& d : samples()) {
    std::set<std::array<std::uint32_t, 3>> faces;
    for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
      if (d.is_dead(c)) continue;
      for (const auto& corner : delaunay::face_corners) {
        const auto& v = d.cells[c].vertices;
        std::array<std::uint32_t, 3> face = {v[corner[0]], v[corner[1]], v[corner[2]]};
        std::sort(face.begin(), face.end());
        if (face[2] != delaunay::ghost_vertex) faces.insert(face);
      }
    }
    const auto n = static_cast<std::uint32_t>(d.vertices.size());
    for (std::uint32_t a = 0; a < n; ++a) {
      for (std::uint32_t b = a + 1; b < n; ++b) {
        for (std::uint32_t c = b + 1; c < n; ++c) {
          const std::uint32_t code = delaunay::find_face(d, a, b, c), reverse = delaunay::find_face(d, c, b, a);
          if (!faces.contains({a, b, c})) {
            ASSERT_EQ(code, delaunay::no_neighbor);
            ASSERT_EQ(reverse, delaunay::no_neighbor);
            continue;
          }
          ASSERT_NE(code, delaunay::no_neighbor);
          expect_face_above(d, code, a, b, c);
          EXPECT_EQ(reverse, d.cells[delaunay::cell_of(code)].neighbors[delaunay::face_of(code)]);
          EXPECT_EQ(delaunay::find_face(d, b, c, a), code);
          EXPECT_EQ(delaunay::find_face(d, c, a, b), code);
        }
      }
    }
  }
}

TEST(HilbertOrder, HoldsEachPointOnce) {
  for (const int n : {0, 1, 2, 100, 30000}) {
    auto order = delaunay::hilbert_order(random_points(n, 31));
    std::sort(order.begin(), order.end());
    ASSERT_EQ(order.size(), static_cast<std::size_t>(n));
    for (std::uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
  }
}

TEST(HilbertOrder, FollowsTheRoundsThatItIsGiven) {
  const auto points = random_points(3000, 33);
  std::vector<std::uint8_t> later_rounds;
  for (std::size_t i = 0; i < points.size(); ++i) later_rounds.push_back(static_cast<std::uint8_t>(i * i % 23));
  const auto order = delaunay::hilbert_order(points, later_rounds);
  ASSERT_EQ(std::set(order.begin(), order.end()).size(), points.size());
  constexpr std::uint8_t first_of_all = 15;
  for (std::size_t i = 1; i < order.size(); ++i)
    ASSERT_GE(std::min(later_rounds[order[i - 1]], first_of_all), std::min(later_rounds[order[i]], first_of_all));
}

/// The points of the first rounds are everywhere: no other point is far from all of them.
TEST(HilbertOrder, SpreadsTheFirstPointsEvenly) {
  const auto points = random_points(16000, 34);
  const auto order = delaunay::hilbert_order(points);
  constexpr std::size_t first = 1000;
  double farthest = 0;
  for (const Point3& p : points) {
    double nearest = HUGE_VAL;
    for (std::size_t i = 0; i < first; ++i) nearest = std::min(nearest, squared_length(points[order[i]] - p));
    farthest = std::max(farthest, nearest);
  }
  EXPECT_LT(std::sqrt(farthest), 2.5 * 0x1p52 / std::cbrt(first));
}

/// Points in random order are half the extent apart; along the curve, by the spacing of a round's points.
TEST(HilbertOrder, PutsNeighborsNextToEachOther) {
  const auto points = random_points(20000, 32);
  const auto order = delaunay::hilbert_order(points);
  double length = 0;
  for (std::size_t i = 1; i < order.size(); ++i)
    length += std::sqrt(squared_length(points[order[i]] - points[order[i - 1]]));
  EXPECT_LT(length / static_cast<double>(points.size()), 3 * 0x1p52 / std::cbrt(points.size()));
}

}  // namespace
}  // namespace ccdt
