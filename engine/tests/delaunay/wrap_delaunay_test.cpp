#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "engine/base/errors.h"
#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/insertion.h"
#include "engine/geometry/predicates.h"
#include "engine/tests/delaunay/delaunay_checks.h"
#include "engine/tests/delaunay/delaunay_point_sets.h"

namespace ccdt {
namespace {

using namespace test;

delaunay::DelaunayVertices with_ranks(const std::vector<Point3>& points, const std::vector<std::uint32_t>& ranks) {
  delaunay::DelaunayVertices vertices;
  for (std::size_t i = 0; i < points.size(); ++i) vertices.push_back({points[i], ranks[i]});
  return vertices;
}

delaunay::Delaunay wrap(const std::vector<Point3>& points, double grid_scale = 1) {
  return delaunay::wrap_delaunay(with_ranks(points, delaunay::insertion_ranks(points)), grid_scale);
}

/// The corners of all ghosts, sorted.
std::vector<Corners> sorted_ghosts(const delaunay::Delaunay& d) {
  std::vector<Corners> ghosts;
  for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
    if (d.is_dead(c) || !d.is_ghost(c)) continue;
    ghosts.push_back(d.cells[c].vertices);
    std::sort(ghosts.back().begin(), ghosts.back().end());
  }
  std::sort(ghosts.begin(), ghosts.end());
  return ghosts;
}

void expect_same(const delaunay::Delaunay& wrapped, const delaunay::Delaunay& inserted, const std::string& name) {
  EXPECT_EQ(sorted_cells(wrapped), sorted_cells(inserted)) << name;
  EXPECT_EQ(sorted_ghosts(wrapped), sorted_ghosts(inserted)) << name;
  EXPECT_TRUE(is_consistent(wrapped)) << name;
}

std::vector<Point3> distinct(std::vector<Point3> points) {
  const auto before = [](const Point3& a, const Point3& b) { return as_array(a) < as_array(b); };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return shuffled(std::move(points), 9);
}

Point3 rounded(const Point3& p, double step) {
  return {std::rint(p.x / step) * step, std::rint(p.y / step) * step, std::rint(p.z / step) * step};
}

/// Rounded to a billionth: flat sides are slanted, and only nearly flat.
std::vector<Point3> turned(std::vector<Point3> points) {
  for (Point3& p : points) {
    const double x = 0.8 * p.x - 0.6 * p.y, y = 0.6 * p.x + 0.8 * p.y;
    p = rounded({x, 0.96 * y - 0.28 * p.z, 0.28 * y + 0.96 * p.z}, 1);
  }
  return distinct(std::move(points));
}

/// Unit vectors, most not exactly on the sphere.
std::vector<Point3> near_sphere(int n) {
  std::mt19937_64 random(41);
  std::normal_distribution<double> normal;
  std::vector<Point3> points;
  for (int i = 0; i < n; ++i) {
    const Point3 p{normal(random), normal(random), normal(random)};
    points.push_back(rounded((0x1p40 / std::sqrt(squared_length(p))) * p, 1));
  }
  return distinct(std::move(points));
}

/// Half of the points in a cube, half in a corner of a tenth of its width.
std::vector<Point3> graded(int n) {
  std::vector<Point3> points = random_points(n, 42);
  for (std::size_t i = 0; i < points.size(); i += 2) points[i] = rounded(0.1 * points[i], 1);
  return distinct(std::move(points));
}

/// Clusters far from each other.
std::vector<Point3> scattered(int n) {
  std::vector<Point3> points = random_points(n, 43);
  const std::vector<Point3> centers = random_points(7, 44);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = rounded(0.9 * centers[i % 7] + 0.001 * points[i], 1);
  return distinct(std::move(points));
}

/// A lattice with a deep slot from above.
std::vector<Point3> slotted_lattice() {
  std::vector<Point3> points = face_centered(9, 1024);
  std::erase_if(points, [](const Point3& p) { return std::fabs(p.x - 4608) < 2000 && p.z > 600; });
  return points;
}

std::vector<Point3> two_planes() {
  std::vector<Point3> points;
  for (int x = 0; x < 16; ++x)
    for (int y = 0; y < 16; ++y)
      for (const double z : {0.0, 5000.0}) points.push_back({1024.0 * x, 1024.0 * y, z});
  return shuffled(std::move(points), 45);
}

std::vector<NamedPoints> hard_sets() {
  return {
      {"five points", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {4, 4, 4}}},
      {"many points near a sphere", near_sphere(1500)},
      {"many points on a sphere", points_on_sphere(1000)},
      {"turned simple cubic lattice", turned(simple_cubic(11, 0x1p30))},
      {"turned box", turned(points_on_box(1500, 46))},
      {"turned planes", turned(two_planes())},
      {"graded", graded(3000)},
      {"scattered", scattered(1500)},
      {"slotted lattice", slotted_lattice()},
      {"turned slotted lattice", turned(slotted_lattice())},
      {"two planes", two_planes()},
      {"large simple cubic lattice", simple_cubic(14)},
      {"large face-centered lattice", face_centered(9)},
      {"large random", random_points(20000, 47)},
  };
}

TEST(WrapDelaunay, GivesTheCellsOfTheDefinition) {
  for (const NamedPoints& set : tiny_sets()) {
    const delaunay::Delaunay d = wrap(set.points);
    EXPECT_EQ(sorted_cells(d), cells_by_definition(d.vertices)) << set.name;
  }
}

TEST(WrapDelaunay, GivesTheCellsOfInsertionWhateverTheGrid) {
  auto sets = tiny_sets();
  for (auto& set : small_sets()) sets.push_back(std::move(set));
  for (const NamedPoints& set : sets) {
    const delaunay::Delaunay inserted = delaunay::build_delaunay(set.points);
    for (const double scale : {0.3, 1.0, 2.5, 100.0})
      expect_same(wrap(set.points, scale), inserted, std::string(set.name) + ", scale " + std::to_string(scale));
  }
}

TEST(WrapDelaunay, GivesTheCellsOfInsertionOnHardSets) {
  for (const NamedPoints& set : hard_sets())
    expect_same(wrap(set.points), delaunay::build_delaunay(set.points), set.name);
}

TEST(WrapDelaunay, LeavesSpheresAndOuterHalfSpacesEmpty) {
  for (const NamedPoints& set : small_sets()) EXPECT_TRUE(has_empty_spheres(wrap(set.points))) << set.name;
}

/// Inserts the vertices in the order of their ranks; the first four are not in one plane.
delaunay::Delaunay insert_by_rank(const delaunay::DelaunayVertices& vertices) {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return vertices[a].rank < vertices[b].rank; });
  std::vector<Point3> first;
  for (int i = 0; i < 4; ++i) first.push_back(vertices[order[i]].point);
  delaunay::Delaunay d = delaunay::build_delaunay(first);
  delaunay::Insertion insertion(d);
  std::uint32_t start = 0;
  for (std::uint32_t i = 4; i < order.size(); ++i) {
    EXPECT_TRUE(insertion.find_cavity(d.add_vertex(vertices[order[i]].point), start));
    start = insertion.fill_cavity();
  }
  for (delaunay::Cell& cell : d.cells)
    for (std::uint32_t& v : cell.vertices)
      if (v != delaunay::ghost_vertex) v = order[v];
  return d;
}

TEST(WrapDelaunay, ObeysAnyRanks) {
  std::mt19937_64 random(48);
  for (const NamedPoints& set : small_sets()) {
    for (int round = 0; round < 3; ++round) {
      // Ranks with gaps, in an order independent of the positions.
      std::vector<std::uint32_t> ranks(set.points.size());
      std::iota(ranks.begin(), ranks.end(), 0u);
      std::array<std::uint32_t, 4> low{};  // the vertices of the first ranks
      do {
        std::shuffle(ranks.begin(), ranks.end(), random);
        for (std::uint32_t v = 0; v < ranks.size(); ++v)
          if (ranks[v] < 4) low[ranks[v]] = v;
      } while (orient3d(set.points[low[0]], set.points[low[1]], set.points[low[2]], set.points[low[3]]) == 0);
      for (std::uint32_t& rank : ranks) rank = 3 * rank + 5;
      const delaunay::Delaunay d = delaunay::wrap_delaunay(with_ranks(set.points, ranks));
      expect_same(d, insert_by_rank(with_ranks(set.points, ranks)), set.name);
      for (std::size_t v = 0; v < ranks.size(); ++v) {
        ASSERT_EQ(d.vertices[v].rank, ranks[v]);
        ASSERT_EQ(d.vertices[v].point, set.points[v]);
      }
    }
  }
}

/// Builds the first points in either way, then inserts the others.
template <class Build>
delaunay::Delaunay build_and_insert(const std::vector<Point3>& points, const Build& build) {
  delaunay::Delaunay d = build({points.begin(), points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2)});
  delaunay::Insertion insertion(d);
  for (std::size_t i = d.vertices.size(); i < points.size(); ++i) {
    EXPECT_TRUE(insertion.find_cavity(d.add_vertex(points[i]), d.cell_at[i % (points.size() / 2)]));
    insertion.fill_cavity();
  }
  return d;
}

TEST(WrapDelaunay, TakesFurtherInsertionsAsAnInsertedOneDoes) {
  for (const NamedPoints& set : small_sets()) {
    const auto wrapped = build_and_insert(set.points, [](const std::vector<Point3>& p) { return wrap(p); });
    const auto inserted =
        build_and_insert(set.points, [](const std::vector<Point3>& p) { return delaunay::build_delaunay(p); });
    expect_same(wrapped, inserted, set.name);
  }
}

TEST(WrapDelaunay, RanksOfInsertionAreThoseThatItGives) {
  for (const NamedPoints& set : small_sets()) {
    const delaunay::Delaunay d = delaunay::build_delaunay(set.points);
    const auto ranks = delaunay::insertion_ranks(set.points);
    ASSERT_EQ(ranks.size(), d.vertices.size());
    for (std::size_t v = 0; v < ranks.size(); ++v) ASSERT_EQ(ranks[v], d.vertices[v].rank) << set.name;
  }
}

TEST(WrapDelaunay, RefusesPointsWithoutABody) {
  const auto refuses = [](const std::vector<Point3>& points) {
    std::vector<std::uint32_t> ranks(points.size());
    std::iota(ranks.begin(), ranks.end(), 0u);
    EXPECT_THROW(delaunay::wrap_delaunay(with_ranks(points, ranks)), MeshError);
  };
  std::vector<Point3> upright, slanted, line, vertical_line;
  for (int i = 0; i < 10; ++i) {
    line.push_back({7.0 * i, 3.0 * i, 5.0 * i});
    vertical_line.push_back({1, 2, 5.0 * i});
    for (int j = 0; j < 10; ++j) {
      upright.push_back({7.0 * i, 3.0 * i, 5.0 * j});
      slanted.push_back({7.0 * i, 3.0 * j, 5.0 * i - 11.0 * j});
    }
  }
  refuses({});
  refuses({{1, 2, 3}});
  refuses({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  refuses(upright);
  refuses(slanted);
  refuses(line);
  refuses(vertical_line);
}

}  // namespace
}  // namespace ccdt
