#include "engine/improve/find_freedom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/geometry/predicates.h"
#include "engine/plc/build_plc.h"
#include "engine/protection/protect_edges.h"
#include "engine/tests/shared/mesh_test_solids.h"

namespace ccdt {
namespace {

using namespace mesh_test;

struct Found {
  plc::Plc plc;
  protection::SegmentChains chains;
  std::vector<Point3> places;  ///< of all vertices
  std::vector<improve::Freedom> freedom;

  /// How many vertices have 0, 1, 2 and 3 dimensions.
  std::array<int, 4> counts() const {
    std::array<int, 4> result = {};
    for (const improve::Freedom& f : freedom) ++result[static_cast<std::size_t>(f.dimensions)];
    return result;
  }
  int dimensions_at(const Point3& world) const {
    const Point3 place = plc.grid.snap(world);
    for (std::size_t v = 0; v < places.size(); ++v)
      if (places[v] == place) return freedom[v].dimensions;
    ADD_FAILURE() << "no vertex there";
    return -1;
  }
};

/// \param interior  how many vertices the mesh has beyond those of the PLC and the Steiner vertices
Found find(const plc::InputPlc& input, bool protect = false, std::size_t interior = 0) {
  Found found{plc::build_plc(input), {}, {}, {}};
  protection::ProtectedDelaunay surface =
      protection::unprotected(found.plc, delaunay::build_delaunay(found.plc.vertices));
  if (protect) {
    surface.must_be_chain.assign(found.plc.segments.size(), true);
    surface = protection::protect_edges(found.plc, std::move(surface), protection::Protection::midpoint);
  }
  found.chains = surface.chains;
  for (const delaunay::DelaunayVertex& v : surface.delaunay.vertices) found.places.push_back(v.point);
  found.freedom = improve::find_freedom(found.plc, found.chains, found.places.size() + interior);
  return found;
}

bool is_integer(const Point3& p) {
  return p.x == std::round(p.x) && p.y == std::round(p.y) && p.z == std::round(p.z);
}

/// Integer steps from a vertex of the PLC stay exactly in the planes of its facet triangles and on the lines of its
/// segments.
void expect_exact_steps(const Found& found) {
  for (std::size_t v = 0; v < found.plc.vertices.size(); ++v) {
    const improve::Freedom& f = found.freedom[v];
    if (f.dimensions == 0) continue;
    const Point3 here = found.places[v];
    EXPECT_TRUE(is_integer(f.u) && is_integer(f.v));
    EXPECT_NE(f.u, Point3{});
    EXPECT_EQ(f.dimensions == 2, f.v != Point3{});
    for (const auto& t : found.plc.triangles) {
      if (t[0] != v && t[1] != v && t[2] != v) continue;
      const auto& at = found.plc.vertices;
      for (const Point3& place : {here + 5.0 * f.u, here - 3.0 * f.v, here + f.u + 7.0 * f.v})
        EXPECT_EQ(orient3d(at[t[0]], at[t[1]], at[t[2]], place), 0);
    }
    for (const plc::Segment& s : found.plc.segments) {
      if (s.ends[0] == v || s.ends[1] == v) {
        EXPECT_EQ(f.dimensions, 1);
        EXPECT_TRUE(collinear(found.plc.vertices[s.ends[0]], found.plc.vertices[s.ends[1]], here + 5.0 * f.u));
      }
    }
  }
}

TEST(FindFreedom, CornersOfACubeStay) {
  const Found found = find(unit_cube());
  EXPECT_EQ(found.counts(), (std::array{8, 0, 0, 0}));
}

TEST(FindFreedom, InteriorVerticesGoAnywhere) {
  const Found found = find(unit_cube(), false, 5);
  EXPECT_EQ(found.counts(), (std::array{8, 0, 0, 5}));
  EXPECT_EQ(found.freedom.back().dimensions, 3);
}

TEST(FindFreedom, VerticesOfAGriddedCubeSlideInItsFacesAndAlongItsEdges) {
  const Found found = find(gridded_cube(4));
  EXPECT_EQ(found.counts(), (std::array{8, 12 * 3, 6 * 9, 0}));
  expect_exact_steps(found);
}

/// Along the axes, the shortest step is one grid unit.
TEST(FindFreedom, StepsAreAsShortAsTheGridAllows) {
  const Found found = find(gridded_cube(4));
  for (const improve::Freedom& f : found.freedom) {
    EXPECT_EQ(squared_length(f.u), f.dimensions > 0 ? 1 : 0);
    EXPECT_EQ(squared_length(f.v), f.dimensions > 1 ? 1 : 0);
  }
}

/// The map is exact, so the faces are still exactly flat, but none has a simple normal.
TEST(FindFreedom, VerticesSlideInObliqueFaces) {
  const auto shear = [](const Point3& p) {
    return Point3{4 * p.x + p.y - 0.5 * p.z, 3 * p.y + 0.25 * p.x + 0.75 * p.z, 5 * p.z + 1.5 * p.x - p.y};
  };
  const Found found = find(mapped(gridded_cube(4), shear));
  EXPECT_EQ(found.counts(), (std::array{8, 12 * 3, 6 * 9, 0}));
  expect_exact_steps(found);
  for (const improve::Freedom& f : found.freedom) {
    if (f.dimensions != 2) continue;
    const double cosine = dot(f.u, f.v) / std::sqrt(squared_length(f.u) * squared_length(f.v));
    EXPECT_LT(std::fabs(cosine), 0.51);
  }
}

TEST(FindFreedom, NothingSlidesOnFacetsThatAreFlatOnlyWithinTheTolerance) {
  const Found found = find(mapped(gridded_cube(4), [](const Point3& p) { return rotated(oblique, p); }));
  ASSERT_EQ(found.plc.facets.size(), 6u);
  int inexact = 0;
  for (const plc::Facet& f : found.plc.facets) inexact += f.exactly_flat ? 0 : 1;
  ASSERT_EQ(inexact, 6);
  EXPECT_EQ(found.counts(), (std::array{98, 0, 0, 0}));
}

TEST(FindFreedom, NothingSlidesOnACurvedSurface) {
  std::mt19937 random(3);
  const Found found = find(random_convex(60, random));
  EXPECT_EQ(found.counts(), (std::array{60, 0, 0, 0}));
}

TEST(FindFreedom, SteinerVerticesSlideAlongTheirSegments) {
  const Found found = find(cube_with_floating_segment(), true);
  int steiner = 0;
  for (std::size_t s = 0; s < found.chains.size(); ++s) {
    const auto chain = found.chains[s];
    const auto& ends = found.plc.segments[s].ends;
    for (std::size_t i = 1; i + 1 < chain.size(); ++i, ++steiner) {
      const improve::Freedom& f = found.freedom[chain[i].vertex];
      EXPECT_EQ(f.dimensions, 1);
      EXPECT_TRUE(collinear(found.places[ends[0]], found.places[ends[1]], found.places[chain[i].vertex] + 9.0 * f.u));
    }
  }
  EXPECT_GT(steiner, 0);
  EXPECT_EQ(found.counts()[1], steiner);
}

/// How many vertices at the middles of all segments may slide.
int sliding_middles(const plc::InputPlc& input) {
  const plc::Plc plc = plc::build_plc(input);
  protection::SegmentChains chains = protection::unprotected(plc, {}).chains;
  auto next = static_cast<std::uint32_t>(plc.vertices.size());
  std::vector<protection::InnerVertex> middles;
  for (std::uint32_t s = 0; s < plc.segments.size(); ++s)
    middles.push_back({s, {VertexId(next++), protection::whole_segment / 2, 1}});
  chains.insert(std::move(middles));
  const std::vector<improve::Freedom> freedom = improve::find_freedom(plc, chains, next);
  return static_cast<int>(std::count_if(freedom.begin() + static_cast<std::ptrdiff_t>(plc.vertices.size()),
                                        freedom.end(), [](const improve::Freedom& f) { return f.dimensions == 1; }));
}

TEST(FindFreedom, SteinerVerticesStayOnFacetsThatAreFlatOnlyWithinTheTolerance) {
  const auto turn = [](const Point3& p) { return rotated(oblique, p); };
  EXPECT_EQ(sliding_middles(gridded_cube(2)), 24);
  EXPECT_EQ(sliding_middles(mapped(gridded_cube(2), turn)), 0);
  // Triangles are always flat.
  EXPECT_EQ(sliding_middles(mapped(schoenhardt(), turn)), 12);
}

/// The cells around such an edge are in two groups, and a move that is right for one may turn the other inside out.
TEST(FindFreedom, NothingSlidesAlongAnEdgeWhereTheDomainTouchesItself) {
  plc::InputPlc plc = gridded_cube(4);
  const auto offset = static_cast<std::uint32_t>(plc.vertices.size());
  for (std::uint32_t v = 0; v < offset; ++v) plc.vertices.push_back(plc.vertices[v] + Point3{1, 1, 0});
  const std::size_t triangles = plc.triangles.size();
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = plc.triangles[t];
    plc.triangles.push_back({a + offset, b + offset, c + offset});
  }
  const Found found = find(plc);
  EXPECT_EQ(found.dimensions_at({1, 1, 0.5}), 0);
  EXPECT_EQ(found.dimensions_at({1, 0, 0.5}), 1);
}

TEST(FindFreedom, IsolatedVerticesStay) {
  plc::InputPlc plc = seeded_cube();
  plc.vertices.push_back({1.5, 1.5, 1.5});
  EXPECT_EQ(find(plc).counts(), (std::array{9, 0, 0, 0}));
}

/// A straight line of three vertices within the cube.
plc::InputPlc cube_with_line() {
  plc::InputPlc plc = seeded_cube();
  plc.vertices.insert(plc.vertices.end(), {{1, 1, 1}, {1.5, 1.5, 1.5}, {2, 2, 2}});
  plc.segments = {{8, 9}, {9, 10}};
  return plc;
}

TEST(FindFreedom, TheMiddleOfAStraightLineSlidesAndItsEndsStay) {
  const Found found = find(cube_with_line());
  EXPECT_EQ(found.counts(), (std::array{10, 1, 0, 0}));
  EXPECT_EQ(found.dimensions_at({1.5, 1.5, 1.5}), 1);
  expect_exact_steps(found);
}

TEST(FindFreedom, AKinkStays) {
  plc::InputPlc plc = cube_with_line();
  plc.vertices.back().x += 0x1p-20;
  EXPECT_EQ(find(plc).counts(), (std::array{11, 0, 0, 0}));
}

TEST(FindFreedom, AThirdSegmentHoldsTheMiddle) {
  plc::InputPlc plc = cube_with_line();
  plc.vertices.push_back({1.5, 1.5, 2});
  plc.segments.push_back({9, 11});
  EXPECT_EQ(find(plc).counts(), (std::array{12, 0, 0, 0}));
}

TEST(FindFreedom, AChangeOfMarkersHoldsTheMiddle) {
  plc::InputPlc plc = cube_with_line();
  plc.segment_markers = {1, 2};
  EXPECT_EQ(find(plc).counts(), (std::array{11, 0, 0, 0}));
  plc.segment_markers = {2, 2};
  EXPECT_EQ(find(plc).counts(), (std::array{10, 1, 0, 0}));
}

/// The line passes through a facet. Its middle is a vertex of that facet, so it must stay there.
TEST(FindFreedom, AFacetThatIsCrossedHoldsTheMiddle) {
  plc::InputPlc plc = seeded_cube();
  plc.vertices.insert(plc.vertices.end(), {{1, 1, 1.5}, {2, 1, 1.5}, {2, 2, 1.5}, {1, 2, 1.5}, {1.5, 1.5, 1.5}});
  plc.vertices.insert(plc.vertices.end(), {{1.5, 1.5, 1}, {1.5, 1.5, 2}});
  for (const std::uint32_t a : {8u, 9u, 10u, 11u}) plc.triangles.push_back({a, a == 11 ? 8 : a + 1, 12});
  EXPECT_EQ(find(plc).dimensions_at({1.5, 1.5, 1.5}), 2);
  plc.segments = {{13, 12}, {12, 14}};
  EXPECT_EQ(find(plc).dimensions_at({1.5, 1.5, 1.5}), 0);
}

/// A line within the facet: the facet continues on both sides of it.
TEST(FindFreedom, AVertexOnALineWithinAFacetSlidesAlongTheLine) {
  plc::InputPlc plc = gridded_cube(4);
  std::map<std::array<double, 3>, std::uint32_t> vertex;
  for (std::uint32_t v = 0; v < plc.vertices.size(); ++v) vertex[as_array(plc.vertices[v])] = v;
  const Found before = find(plc);
  // Along the middle of the face on which z is 0, from edge to edge.
  for (int i = 0; i < 4; ++i)
    plc.segments.push_back({vertex.at({0.25 * i, 0.5, 0}), vertex.at({0.25 * (i + 1), 0.5, 0})});
  const Found after = find(plc);
  EXPECT_EQ(before.dimensions_at({0.5, 0.5, 0}), 2);
  EXPECT_EQ(after.dimensions_at({0.5, 0.5, 0}), 1);
  // Where the line meets the edges of the cube, it ends.
  EXPECT_EQ(before.dimensions_at({0, 0.5, 0}), 1);
  EXPECT_EQ(after.dimensions_at({0, 0.5, 0}), 0);
  expect_exact_steps(after);
}

}  // namespace
}  // namespace ccdt
