#include "engine/delaunay/insertion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>

#include "engine/tests/delaunay/delaunay_checks.h"
#include "engine/tests/delaunay/delaunay_point_sets.h"

namespace ccdt {
namespace {

using namespace test;

/// Adds a vertex of the greatest rank, but does not insert it into the tetrahedralization yet.
std::uint32_t first_living_cell(const delaunay::Delaunay& d) {
  std::uint32_t c = 0;
  while (d.is_dead(c)) ++c;
  return c;
}

std::set<std::uint32_t> cavity_vertices(const delaunay::Insertion& insertion) {
  std::set<std::uint32_t> vertices;
  for (const delaunay::CavityFace& face : insertion.cavity_faces())
    vertices.insert(face.vertices.begin(), face.vertices.end());
  return vertices;
}

/// The first half of the points at once, the others one by one.
delaunay::Delaunay build_in_two_steps(const std::vector<Point3>& points) {
  delaunay::Delaunay d = delaunay::build_delaunay(std::span(points).first(points.size() / 2));
  delaunay::Insertion insertion(d);
  std::uint32_t start = first_living_cell(d);
  for (std::size_t i = d.vertices.size(); i < points.size(); ++i) {
    EXPECT_TRUE(insertion.find_cavity(d.add_vertex(points[i]), start));
    start = insertion.fill_cavity();
  }
  return d;
}

TEST(Insertion, OneByOneGivesTheCellsOfTheDefinition) {
  for (const NamedPoints& set : tiny_sets()) {
    if (set.points.size() < 16) continue;
    const delaunay::Delaunay d = build_in_two_steps(set.points);
    EXPECT_EQ(sorted_cells(d), cells_by_definition(d.vertices)) << set.name;
  }
}

TEST(Insertion, OneByOneGivesADelaunayTetrahedralization) {
  for (const NamedPoints& set : small_sets()) {
    const delaunay::Delaunay d = build_in_two_steps(set.points);
    EXPECT_TRUE(is_consistent(d)) << set.name;
    EXPECT_TRUE(has_empty_spheres(d)) << set.name;
  }
}

TEST(Insertion, OneByOneGivesWhatBuildingAtOnceGivesWhereNoRankDecides) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto points = random_points(3000, seed);
    EXPECT_EQ(sorted_cells(build_in_two_steps(points)), sorted_cells(delaunay::build_delaunay(points)));
  }
}

TEST(Insertion, KeepsTheStructureConsistentAfterEachVertex) {
  for (const NamedPoints& set : tiny_sets()) {
    const std::size_t given = set.points.size() / 2;
    if (given < 8) continue;
    delaunay::Delaunay d = delaunay::build_delaunay(std::span(set.points).first(given));
    delaunay::Insertion insertion(d);
    for (std::size_t i = given; i < set.points.size(); ++i) {
      const std::uint32_t far = d.cell_at[i % given];
      ASSERT_TRUE(insertion.find_cavity(d.add_vertex(set.points[i]), far)) << set.name;
      insertion.fill_cavity();
      ASSERT_TRUE(is_consistent(d)) << set.name << ", vertex " << i;
      ASSERT_TRUE(has_empty_spheres(d)) << set.name << ", vertex " << i;
    }
  }
}

TEST(Insertion, FindsTheSameCavityFromEveryCell) {
  delaunay::Delaunay d = delaunay::build_delaunay(face_centered(2, 4));
  delaunay::Insertion insertion(d);
  for (const Point3& p : {Point3{1, 1, 1}, {3, 4, 5}, {-1, 2, 2}, {4, 4, 9}, {2, 1, 0}}) {
    const std::uint32_t v = d.add_vertex(p);
    std::set<std::uint32_t> expected;
    for (std::uint32_t start = 0; start < d.cells.size(); ++start) {
      if (d.is_dead(start)) continue;
      ASSERT_TRUE(insertion.find_cavity(v, start));
      const auto cells = insertion.cavity_cells();
      const std::set<std::uint32_t> cavity(cells.begin(), cells.end());
      EXPECT_EQ(cavity.size(), cells.size());
      if (expected.empty()) expected = cavity;
      EXPECT_EQ(cavity, expected);
      insertion.discard_cavity();
    }
    d.remove_last_vertex();
  }
}

TEST(Insertion, TheCavityIsClosedAndItsFacesLookAtTheNewVertex) {
  for (const NamedPoints& set : small_sets()) {
    delaunay::Delaunay d = delaunay::build_delaunay(std::span(set.points).first(set.points.size() - 1));
    delaunay::Insertion insertion(d);
    ASSERT_TRUE(insertion.find_cavity(d.add_vertex(set.points.back()), first_living_cell(d))) << set.name;
    std::set<std::uint32_t> outside;
    for (const delaunay::CavityFace& face : insertion.cavity_faces()) {
      const delaunay::Cell& cell = d.cells[delaunay::cell_of(face.outside)];
      EXPECT_FALSE(insertion.in_cavity(delaunay::cell_of(face.outside)));
      EXPECT_TRUE(insertion.in_cavity(delaunay::cell_of(cell.neighbors[delaunay::face_of(face.outside)])));
      EXPECT_TRUE(outside.insert(face.outside).second) << "a face is there twice";
      for (const std::uint32_t v : face.vertices)
        EXPECT_NE(std::find(cell.vertices.begin(), cell.vertices.end(), v), cell.vertices.end());
    }
    for (const std::uint32_t c : insertion.cavity_cells()) {
      for (const std::uint32_t code : d.cells[c].neighbors)
        EXPECT_NE(insertion.in_cavity(delaunay::cell_of(code)), outside.contains(code)) << set.name;
    }
  }
}

TEST(Insertion, DiscardingACavityLeavesEverythingAsItWas) {
  for (const NamedPoints& set : small_sets()) {
    const auto most = std::span(set.points).first(set.points.size() - 10);
    delaunay::Delaunay d = delaunay::build_delaunay(most);
    delaunay::Insertion insertion(d);
    const delaunay::Delaunay before = d;
    const std::uint32_t start = first_living_cell(d);
    for (const Point3& p : std::span(set.points).last(10)) {
      const std::uint32_t v = d.add_vertex(p);
      ASSERT_TRUE(insertion.find_cavity(v, start)) << set.name;
      EXPECT_FALSE(insertion.cavity_cells().empty());
      insertion.discard_cavity();
      EXPECT_TRUE(insertion.cavity_cells().empty() && insertion.cavity_faces().empty());
      for (std::uint32_t c = 0; c < d.cells.size(); ++c) ASSERT_FALSE(insertion.in_cavity(c));
      d.remove_last_vertex();
      ASSERT_TRUE(are_equal(d, before)) << set.name;
    }
    // After discarded cavities, insertion works as if there had been none.
    delaunay::Delaunay fresh = before;
    delaunay::Insertion never_abandoned(fresh);
    for (const Point3& p : std::span(set.points).last(10)) {
      ASSERT_TRUE(insertion.find_cavity(d.add_vertex(p), d.cell_at[0])) << set.name;
      ASSERT_TRUE(never_abandoned.find_cavity(fresh.add_vertex(p), fresh.cell_at[0])) << set.name;
      insertion.fill_cavity();
      never_abandoned.fill_cavity();
    }
    EXPECT_TRUE(is_consistent(d)) << set.name;
    EXPECT_EQ(sorted_cells(d), sorted_cells(fresh)) << set.name;
  }
}

TEST(Insertion, NamesTheVertexAtTheSamePlace) {
  for (const NamedPoints& set : small_sets()) {
    delaunay::Delaunay d = delaunay::build_delaunay(set.points);
    delaunay::Insertion insertion(d);
    const delaunay::Delaunay before = d;
    for (std::uint32_t v = 0; v < set.points.size(); v += 7) {
      const std::uint32_t copy = d.add_vertex(set.points[v]);
      EXPECT_FALSE(insertion.find_cavity(copy, d.cell_at[set.points.size() / 2])) << set.name;
      EXPECT_EQ(insertion.twin(), v) << set.name;
      d.remove_last_vertex();
      ASSERT_TRUE(are_equal(d, before)) << set.name;
    }
  }
}

/// The center of a sphere is in the circumsphere of every cell of points on it: its cavity has all vertices. The
/// numbers of vertices are near those where the connection of new cells switches methods.
TEST(Insertion, FillsCavitiesOfManyVertices) {
  const auto sphere = points_on_sphere(300);
  for (const std::size_t n : {62, 63, 64, 65, 66, 127, 128, 129, 253, 254, 255, 256, 257, 300}) {
    auto points = shuffled(sphere, n);
    points.resize(n);
    delaunay::Delaunay d = delaunay::build_delaunay(points);
    delaunay::Insertion insertion(d);
    const std::uint32_t center = d.add_vertex({});
    ASSERT_TRUE(insertion.find_cavity(center, first_living_cell(d)));
    EXPECT_EQ(cavity_vertices(insertion).size(), n);
    insertion.fill_cavity();
    EXPECT_TRUE(is_consistent(d)) << n;
    EXPECT_TRUE(has_empty_spheres(d)) << n;
  }
}

/// The same with the ghost among the vertices of the border: a point so far out that it sees half of the sphere.
TEST(Insertion, FillsCavitiesOfManyVerticesBeyondTheHull) {
  const auto sphere = points_on_sphere(500);
  for (const std::size_t n : {100, 200, 300, 500}) {
    auto points = shuffled(sphere, n);
    points.resize(n);
    delaunay::Delaunay d = delaunay::build_delaunay(points);
    delaunay::Insertion insertion(d);
    ASSERT_TRUE(insertion.find_cavity(d.add_vertex({1000003, 1000, 10}), first_living_cell(d)));
    const auto border = cavity_vertices(insertion);
    EXPECT_TRUE(border.contains(delaunay::ghost_vertex));
    if (n == 500) {
      EXPECT_GT(border.size(), 200u);
    }
    insertion.fill_cavity();
    EXPECT_TRUE(is_consistent(d)) << n;
    EXPECT_TRUE(has_empty_spheres(d)) << n;
  }
}

TEST(InsertPoints, GivesIdsAndRanksThatFollowTheExistingOnes) {
  for (const NamedPoints& set : tiny_sets()) {
    if (set.points.size() < 16) continue;
    const std::size_t half = set.points.size() / 2;
    const std::span<const Point3> points = set.points;
    delaunay::Delaunay d = delaunay::build_delaunay(points.first(half));
    delaunay::insert_points(d, points.subspan(half));
    for (std::uint32_t v = static_cast<std::uint32_t>(half); v < d.vertices.size(); ++v)
      EXPECT_EQ(d.vertices[v].rank, v);
    EXPECT_TRUE(is_consistent(d)) << set.name;
    EXPECT_EQ(sorted_cells(d), cells_by_definition(d.vertices)) << set.name;
  }
}

}  // namespace
}  // namespace ccdt
