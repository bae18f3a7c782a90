#include "engine/repair/cut_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/geometry/contacts.h"
#include "engine/geometry/integer_points.h"
#include "engine/geometry/predicates.h"
#include "engine/plc/close_triangles.h"
#include "engine/repair/cut_crossings.h"
#include "engine/tests/shared/plc_test_solids.h"
#include "engine/tests/shared/sanitized.h"
#include "models/solids.h"

namespace ccdt {
namespace {

using plc_test::append;
using plc_test::rotated;

/// Do two triangles with a common edge lie on each other?
bool are_folded(std::span<const Point3> points, const plc::VertexTriple& s, const plc::VertexTriple& t) {
  std::vector<VertexId> common;
  for (const VertexId v : s)
    if (plc::has_corner(t, v)) common.push_back(v);
  const Point3 &a = points[common[0]], &b = points[common[1]];
  const Point3 &c = points[plc::apex_over(s, common[0], common[1])],
               &d = points[plc::apex_over(t, common[0], common[1])];
  const int axis = dominant_axis({a, b, c});
  return orient3d(a, b, c, d) == 0 && orient_along(axis, a, b, c) == orient_along(axis, a, b, d);
}

bool do_meet(std::span<const Point3> points, plc::VertexTriple s, plc::VertexTriple t) {
  const auto common = std::ranges::count_if(s, [&](VertexId v) { return plc::has_corner(t, v); });
  if (common == 3) return true;
  if (common == 2) return are_folded(points, s, t);
  if (common == 0) return meet_triangles(plc::points_of(points, s), plc::points_of(points, t)).has_value();
  while (!plc::has_corner(t, s[0])) std::ranges::rotate(s, s.begin() + 1);
  while (t[0] != s[0]) std::ranges::rotate(t, t.begin() + 1);
  return meet_triangles_at_corner(plc::points_of(points, s), plc::points_of(points, t)).has_value();
}

/// Pairs of triangles that meet in more than common corners and edges, by the tests of the checks of a PLC.
std::size_t meeting_pairs(const plc::UncheckedPlc& soup) {
  const std::vector<Point3>& points = soup.plc.vertices;
  std::size_t count = 0;
  for (const auto& [s, t] : plc::find_close_triangles(points, soup.triangles))
    count += do_meet(points, soup.triangles.corners[s], soup.triangles.corners[t]);
  return count;
}

/// The area of the triangles of each facet of the input, in grid units.
std::map<std::uint32_t, double> areas(const plc::UncheckedPlc& soup) {
  std::map<std::uint32_t, double> sums;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
    sums[soup.triangles.numbers[t]] +=
        0.5 * length(area_vector(plc::points_of(soup.plc.vertices, soup.triangles.corners[t])));
  return sums;
}

struct Result {
  plc::InputPlc input;
  plc::UncheckedPlc soup;
  repair::CutCounts counts;
};

Result cut(plc::InputPlc input) {
  Result result{std::move(input), {}, {}};
  result.soup = plc::gather_plc(result.input);
  result.counts = repair::cut_crossings(result.soup);
  return result;
}

plc::InputPlc moved(plc::InputPlc plc, const Point3& by, double scale = 1) {
  for (Point3& p : plc.vertices) p = scale * p + by;
  return plc;
}

plc::InputPlc both(plc::InputPlc one, const plc::InputPlc& other) {
  append(one, other);
  return one;
}

/// Expects that nothing meets and that the result is a valid PLC; returns it.
plc::Plc expect_valid(const Result& result) {
  EXPECT_EQ(result.counts.left, 0u);
  EXPECT_EQ(meeting_pairs(result.soup), 0u);
  EXPECT_EQ(result.soup.plc.vertices.size(), result.soup.plc.world.size());
  try {
    return plc::check_plc(result.input, result.soup);
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
    return {};
  }
}

void expect_same_areas(const Result& result) {
  const auto before = areas(plc::gather_plc(result.input)), after = areas(result.soup);
  for (const auto& [number, area] : before) {
    const auto there = after.find(number);
    ASSERT_NE(there, after.end()) << number;
    EXPECT_NEAR(there->second, area, 1e-8 * area + 1e-8 * 0x1p104) << number;
  }
}

TEST(CutCrossings, CutTwoTrianglesThatCross) {
  plc::InputPlc input;
  input.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {9, 9, 0}};
  input.triangles = {{0, 1, 2}, {3, 4, 5}};
  input.triangle_markers = {3, 7};
  const Result result = cut(input);
  EXPECT_EQ(result.counts.pairs, 1u);
  EXPECT_EQ(result.counts.rounds, 1u);
  EXPECT_EQ(result.counts.left, 0u);
  EXPECT_EQ(meeting_pairs(result.soup), 0u);
  // One end is where the edge 34 passes through 012, the other where the edge 12 passes through 345.
  EXPECT_EQ(result.soup.plc.vertices.size(), 8u);
  for (std::uint32_t t = 0; t < result.soup.triangles.size(); ++t)
    EXPECT_EQ(result.soup.triangles.markers[t], result.soup.triangles.numbers[t] == 0 ? 3 : 7);
  expect_same_areas(result);
}

TEST(CutCrossings, KeepASoupWithoutCrossings) {
  for (const char* name : {"sphere", "cube", "torus"}) {
    const plc::UncheckedPlc before = plc::gather_plc(models::make_solid(name, 0.2));
    plc::UncheckedPlc after = before;
    const repair::CutCounts counts = repair::cut_crossings(after);
    EXPECT_EQ(counts.pairs + counts.rounds + counts.left, 0u);
    EXPECT_EQ(after.plc.vertices, before.plc.vertices);
    EXPECT_EQ(after.plc.world, before.plc.world);
    EXPECT_EQ(after.triangles.corners, before.triangles.corners);
    EXPECT_EQ(after.triangles.markers, before.triangles.markers);
    EXPECT_EQ(after.triangles.numbers, before.triangles.numbers);
    EXPECT_EQ(after.triangles.faces, before.triangles.faces);
  }
}

TEST(CutCrossings, UnfoldATriangleThatLiesOnItsNeighbor) {
  plc::InputPlc input;
  input.vertices = {{0, 0, 0}, {4, 0, 0}, {1, 4, 0}, {3, 4, 0}};
  input.triangles = {{0, 1, 2}, {1, 0, 3}};
  const Result result = cut(input);
  EXPECT_EQ(result.counts.pairs, 1u);
  EXPECT_EQ(result.counts.left, 0u);
  EXPECT_EQ(meeting_pairs(result.soup), 0u);
  EXPECT_EQ(result.soup.plc.vertices.size(), 5u);
  EXPECT_EQ(result.soup.triangles.size(), 2u);  // nothing is left where there were two, facing opposite ways
}

TEST(CutCrossings, RoundAllVerticesToTheSpacing) {
  for (const double spacing : {2 * DyadicGrid::quantum, 0x1p10 * DyadicGrid::quantum, 0x1p20 * DyadicGrid::quantum}) {
    const plc::InputPlc sphere = models::make_solid("sphere", 0.3);
    const plc::InputPlc other = moved(rotated(plc_test::arbitrary, sphere), {0.31, 0.57, 0.23});
    Result result{both(sphere, other), {}, {}};
    result.soup = plc::gather_plc(result.input);
    const plc::UncheckedPlc before = result.soup;
    result.counts = repair::cut_crossings(result.soup, {.spacing = spacing});
    EXPECT_EQ(expect_valid(result).regions.size(), 4u);
    EXPECT_EQ(result.soup.plc.grid.unit, before.plc.grid.unit);
    for (const Point3& p : result.soup.plc.vertices)
      for (const double x : as_array(p)) EXPECT_EQ(std::remainder(x, spacing), 0) << x;
    for (std::size_t v = 0; v < before.plc.vertices.size(); ++v) {
      const VertexId now = result.soup.plc.vertex_of_input[v];
      EXPECT_LE(length(result.soup.plc.vertices[now] - before.plc.vertices[v]), spacing) << v;
      EXPECT_EQ(result.soup.plc.grid.to_world(result.soup.plc.vertices[now]), result.soup.plc.world[now]) << v;
    }
  }
}

TEST(CutCrossings, FindAllRegionsOfTwoCubes) {
  const plc::InputPlc other = moved(rotated(plc_test::arbitrary, plc_test::unit_cube()), {0.31, 0.57, 0.23});
  const Result result = cut(both(plc_test::unit_cube(), other));
  const plc::Plc plc = expect_valid(result);
  EXPECT_GT(result.counts.pairs, 0u);
  EXPECT_EQ(plc.regions.size(), 4u);
  expect_same_areas(result);
}

TEST(CutCrossings, FindAllRegionsOfTwoParallelCubes) {
  const Result result = cut(both(plc_test::unit_cube(), moved(plc_test::unit_cube(), {0.3, 0.4, 0.6})));
  const plc::Plc plc = expect_valid(result);
  EXPECT_EQ(plc.regions.size(), 4u);
  double sum = 0;
  for (std::uint32_t r = 1; r < plc.regions.size(); ++r) sum += plc_test::volume(plc, r);
  EXPECT_NEAR(sum, 2 - 0.7 * 0.6 * 0.4, 1e-8);
  expect_same_areas(result);
}

TEST(CutCrossings, MergeFacesOfTwoCubesInOnePlane) {
  // Bottom and top are in the same planes, the other faces cross.
  const Result crossing = cut(both(plc_test::unit_cube(), moved(plc_test::unit_cube(), {0.3, 0.4, 0})));
  EXPECT_EQ(expect_valid(crossing).regions.size(), 4u);
  // The second cube stands on the first one and hangs over.
  const Result on_top = cut(both(plc_test::unit_cube(), moved(plc_test::unit_cube(), {0.3, 0.4, 1})));
  EXPECT_EQ(expect_valid(on_top).regions.size(), 3u);
  // It is turned about the common normal.
  const auto turned = rotated(plc_test::rotation(1, 0, 0, 0.3), moved(plc_test::unit_cube(), {-0.5, -0.5, 0}));
  const Result rotated_on_top = cut(both(plc_test::unit_cube(), moved(turned, {0.52, 0.47, 1})));
  EXPECT_EQ(expect_valid(rotated_on_top).regions.size(), 3u);
  // It is the same cube.
  const Result same = cut(both(plc_test::unit_cube(), plc_test::unit_cube()));
  EXPECT_EQ(expect_valid(same).regions.size(), 2u);
  EXPECT_EQ(same.counts.rounds, 0u);
}

/// Two triangles in each of three planes, in general position.
plc::InputPlc three_quadrilaterals() {
  plc::InputPlc input;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto first = static_cast<std::uint32_t>(input.vertices.size());
    for (const auto& [u, v] : {std::array{-1.0, -1.0}, {1.3, -1.0}, {1.0, 1.1}, {-1.0, 0.9}}) {
      std::array<double, 3> p{};
      p[axis] = 0.1 * u - 0.07 * v;
      p[(axis + 1) % 3] = u;
      p[(axis + 2) % 3] = v + 0.13;
      input.vertices.push_back({p[0], p[1], p[2]});
    }
    plc_test::append_fan(input, {first, first + 1, first + 2, first + 3});
  }
  return rotated(plc_test::arbitrary, input);
}

TEST(CutCrossings, MakeOneVertexWhereThreePlanesMeet) {
  const Result result = cut(three_quadrilaterals());
  EXPECT_EQ(result.counts.left, 0u);
  EXPECT_EQ(meeting_pairs(result.soup), 0u);
  std::map<VertexId, std::set<std::uint32_t>> planes_at;
  for (std::uint32_t t = 0; t < result.soup.triangles.size(); ++t)
    for (const VertexId v : result.soup.triangles.corners[t]) planes_at[v].insert(result.soup.triangles.numbers[t] / 2);
  EXPECT_EQ(std::ranges::count_if(planes_at, [](const auto& at) { return at.second.size() == 3; }), 1);
  expect_same_areas(result);
}

TEST(CutCrossings, CutASphereAndARotatedCopy) {
  const plc::InputPlc sphere = models::make_solid("sphere", 0.15);
  const Result result = cut(both(sphere, moved(rotated(plc_test::arbitrary, sphere), {0.13, 0.07, -0.05})));
  EXPECT_EQ(expect_valid(result).regions.size(), 4u);
  expect_same_areas(result);
}

TEST(CutCrossings, DoNotDependOnTheNumberOfThreads) {
  const plc::InputPlc sphere = models::make_solid("sphere", 0.2);
  const plc::InputPlc input = both(sphere, rotated(plc_test::arbitrary, sphere));
  const Result one = with_threads(1, [&] { return cut(input); }), four = with_threads(4, [&] { return cut(input); });
  EXPECT_EQ(one.soup.plc.vertices, four.soup.plc.vertices);
  EXPECT_EQ(one.soup.triangles.corners, four.soup.triangles.corners);
  EXPECT_EQ(one.soup.triangles.numbers, four.soup.triangles.numbers);
}

TEST(CutCrossings, DivideSegmentsWithTheirEdges) {
  plc::InputPlc input;
  input.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1.1, 1.3}, {9, 9, 0}};
  input.triangles = {{0, 1, 2}, {3, 4, 5}};
  input.segments = {{3, 4}, {0, 1}};
  input.segment_markers = {5, 6};
  const Result result = cut(input);
  EXPECT_EQ(result.soup.segments.markers, (std::vector{5, 5, 6}));
}

constexpr unsigned most_seeds = is_sanitized ? 50 : 200;

// ---- Random solids --------------------------------------------------------------------------------------------------

plc::InputPlc tetrahedron(const std::array<Point3, 4>& corners) {
  plc::InputPlc input;
  input.vertices.assign(corners.begin(), corners.end());
  input.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return input;
}

plc::InputPlc random_solid(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Point3{uniform(random), uniform(random), uniform(random)}; };
  plc::InputPlc solid = random() % 2 == 0 ? moved(plc_test::unit_cube(), {-0.5, -0.5, -0.5})
                                          : tetrahedron({point(), point(), point(), point()});
  const auto matrix = plc_test::rotation(uniform(random), uniform(random), uniform(random), uniform(random));
  return moved(rotated(matrix, solid), 0.5 * point(), 0.5 + 0.4 * uniform(random));
}

/// Of small integers: many corners, edges and faces touch each other or are in one plane.
plc::InputPlc random_solid_on_lattice(std::mt19937& random) {
  const auto point = [&](int most) {
    const auto coordinate = [&] { return double(int(random() % static_cast<unsigned>(most + 1))); };
    return Point3{coordinate(), coordinate(), coordinate()};
  };
  if (random() % 2 == 0) {
    const Point3 low = point(3);
    return plc_test::box(low, low + point(2) + Point3{1, 1, 1});
  }
  for (;;) {
    const std::array<Point3, 4> p = {point(5), point(5), point(5), point(5)};
    if (dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) != 0) return tetrahedron(p);
  }
}

/// Two to five solids.
template <class MakeSolid>
plc::InputPlc random_soup(unsigned seed, const MakeSolid& make_solid) {
  std::mt19937 random(seed);
  plc::InputPlc input = make_solid(random);
  for (unsigned i = 0; i < 1 + seed % 4; ++i) append(input, make_solid(random));
  return input;
}

TEST(CutCrossings, EndForRandomSolids) {
  for (unsigned seed = 0; seed < most_seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Result result = cut(random_soup(seed, random_solid));
    EXPECT_LE(result.counts.rounds, 1u);
    expect_valid(result);
    expect_same_areas(result);
  }
}

TEST(CutCrossings, EndForRandomSolidsOnALattice) {
  for (unsigned seed = 0; seed < most_seeds; ++seed) {
    SCOPED_TRACE(seed);
    expect_valid(cut(random_soup(seed, random_solid_on_lattice)));
  }
}

/// Their facets touch only within the rounding of their vertices.
TEST(CutCrossings, WeldTurnedSolidsOfALattice) {
  for (unsigned seed = 0; seed < most_seeds; ++seed) {
    SCOPED_TRACE(seed);
    const plc::InputPlc input = random_soup(seed, random_solid_on_lattice);
    const Result straight = cut(input), turned = cut(rotated(plc_test::arbitrary, input));
    EXPECT_EQ(expect_valid(turned).regions.size(), expect_valid(straight).regions.size());
  }
}

TEST(CutCrossings, WeldTurnedCubesThatStandOnEachOther) {
  for (const double x : {0.0, 0.25, 0.3}) {
    const plc::InputPlc cubes = both(plc_test::unit_cube(), moved(plc_test::unit_cube(), {x, 0.4, 1}));
    EXPECT_EQ(expect_valid(cut(rotated(plc_test::arbitrary, cubes))).regions.size(), 3u);
  }
}

TEST(CutCrossings, WeldCopiesWithinTheRounding) {
  const plc::InputPlc sphere = models::make_solid("sphere", 0.2);
  for (const double shift : {1e-10, 1e-9}) {
    const Result result = cut(both(sphere, moved(sphere, {shift, shift / 3, -shift / 2})));
    EXPECT_EQ(expect_valid(result).regions.size(), 2u);
    EXPECT_EQ(result.soup.triangles.size(), sphere.triangles.size());
    for (const VertexId v : result.soup.plc.vertex_of_input) EXPECT_LT(v, result.soup.plc.vertices.size());
  }
}

}  // namespace
}  // namespace ccdt
