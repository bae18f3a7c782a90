#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/base/errors.h"
#include "engine/tests/shared/plc_test_solids.h"

namespace ccdt {
namespace {

using namespace plc_test;

using Inside = plc::InputPlc::Inside;

std::vector<double> inside_volumes(const plc::Plc& plc) {
  std::vector<double> volumes;
  for (std::uint32_t c = 0; c < plc.regions.size(); ++c)
    if (plc.regions[c].inside) volumes.push_back(volume(plc, c));
  std::sort(volumes.begin(), volumes.end());
  return volumes;
}

plc::InputPlc cube_in_cube() {
  plc::InputPlc plc = box({0, 0, 0}, {4, 4, 4});
  append(plc, box({1, 1, 1}, {2, 2, 2}));
  return plc;
}

/// Two unit cubes side by side in x; their common face occurs once.
plc::InputPlc two_cubes() {
  plc::InputPlc plc = unit_cube();
  plc::InputPlc second = box({1, 0, 0}, {2, 1, 1});
  std::erase_if(second.triangles, [&](const Triangle& t) {
    return second.vertices[t[0]].x == 1 && second.vertices[t[1]].x == 1 && second.vertices[t[2]].x == 1;
  });
  append(plc, second);
  return plc;
}

TEST(PlcRegions, TwoCubesThatShareAFaceAreTwoRegionsInASurface) {
  const plc::Plc plc = plc::build_plc(two_cubes());
  EXPECT_EQ(plc.vertices.size(), 12u);
  EXPECT_EQ(plc.facets.size(), 11u) << "where three facets meet, the sides of the cubes end";
  EXPECT_EQ(plc.segments.size(), 20u);
  EXPECT_EQ(plc.regions.size(), 3u);
  EXPECT_EQ(inside_volumes(plc), (std::vector<double>{1, 1}));
  EXPECT_EQ(grazeable_count(plc), 0u) << "the edges of the shared face have 90 degrees on each side";
}

TEST(PlcRegions, RegionSeedsNameTheRegionsOfTwoCubes) {
  plc::InputPlc input = two_cubes();
  input.inside = Inside::seeds;
  input.regions = {{{0.5, 0.5, 0.5}, 7, 0}, {{1.5, 0.25, 0.5}, 8, 0}};
  for (const Matrix& m : {rotation(1, 0, 0, 0), arbitrary}) {
    const plc::Plc plc = plc::build_plc(rotated(m, input));
    ASSERT_EQ(plc.regions.size(), 3u);
    std::multiset<int> regions;
    for (const plc::Region& c : plc.regions)
      if (c.inside) regions.insert(c.attribute);
    EXPECT_EQ(regions, (std::multiset<int>{7, 8}));
  }
}

std::vector<int> attributes_inside(const plc::Plc& plc) {
  std::vector<int> attributes;
  for (const plc::Region& c : plc.regions)
    if (c.inside) attributes.push_back(c.attribute);
  std::ranges::sort(attributes);
  return attributes;
}

TEST(PlcRegions, WithoutASeedAreNumberedFromOne) {
  plc::InputPlc input = two_cubes();
  EXPECT_EQ(attributes_inside(plc::build_plc(input)), (std::vector<int>{1, 2}));
  input.inside = Inside::seeds;
  EXPECT_EQ(attributes_inside(plc::build_plc(input)), (std::vector<int>{1, 2}));
  input.regions = {{{0.5, 0.5, 0.5}, 1, 0}};
  EXPECT_EQ(attributes_inside(plc::build_plc(input)), (std::vector<int>{1, 2})) << "1 is taken";
  input.regions[0].attribute = 2;
  EXPECT_EQ(attributes_inside(plc::build_plc(input)), (std::vector<int>{1, 2})) << "1 is not";
  input.regions[0].attribute = 0;
  EXPECT_EQ(attributes_inside(plc::build_plc(input)), (std::vector<int>{0, 1})) << "as the file says";
  EXPECT_EQ(attributes_inside(plc::build_plc(cube_in_cube())), std::vector<int>{1});
}

TEST(PlcRegions, ACubeInACubeIsAHoleInASurface) {
  const plc::Plc plc = plc::build_plc(cube_in_cube());
  EXPECT_EQ(plc.regions.size(), 3u);
  EXPECT_EQ(inside_volumes(plc), std::vector<double>{63});
  EXPECT_EQ(grazeable_count(plc), 12u) << "all edges of the hole";
}

TEST(PlcRegions, ACubeInACubeIsAnInclusionInAPlc) {
  plc::InputPlc input = cube_in_cube();
  input.inside = Inside::seeds;
  const plc::Plc plc = plc::build_plc(input);
  EXPECT_EQ(inside_volumes(plc), (std::vector<double>{1, 63}));
  EXPECT_EQ(grazeable_count(plc), 12u);
}

TEST(PlcRegions, AHoleSeedEmptiesTheCubeInACube) {
  plc::InputPlc input = cube_in_cube();
  input.inside = Inside::seeds;
  input.holes = {{1.5, 1.25, 1.5}};
  for (const Matrix& m : {rotation(1, 0, 0, 0), arbitrary}) {
    const plc::Plc plc = plc::build_plc(rotated(m, input));
    ASSERT_EQ(inside_volumes(plc).size(), 1u);
    EXPECT_NEAR(inside_volumes(plc)[0], 63, 1e-6);
  }
}

TEST(PlcRegions, NestedSurfacesAlternateHoweverTheyAreTurnedAndOrdered) {
  for (const bool outermost_first : {true, false})
    for (const Matrix& m : {rotation(1, 0, 0, 0), arbitrary}) {
      plc::InputPlc input;
      for (int k = 0; k < 5; ++k) {
        const double r = outermost_first ? 5 - k : k + 1;
        append(input, box({-r, -r, -r}, {r, r, r}));
      }
      const plc::Plc plc = plc::build_plc(rotated(m, input));
      EXPECT_EQ(plc.regions.size(), 6u);
      EXPECT_NEAR(inside_volume(plc), 8 * (125 - 64 + 27 - 8 + 1), 1e-6);
    }
}

// Two L in one box, each with a part straight above a part of the other, so that neither need see the box first.
TEST(PlcRegions, InterlockedComponentsFindWhatEnclosesThem) {
  plc::InputPlc input = box({-10, -10, -10}, {10, 10, 10});
  plc::InputPlc up = prism({{1, 1}, {1, 4}, {0, 4}, {0, 0}, {4, 0}, {4, 1}});  // an L, standing in z
  for (Point3& p : up.vertices) p = {p.x, p.z, p.y};
  plc::InputPlc down = up;
  for (Point3& p : down.vertices) p = {5 - p.x, p.y, 5 - p.z};
  append(input, up);
  append(input, down);
  const plc::Plc plc = plc::build_plc(input);
  EXPECT_EQ(plc.regions.size(), 4u);
  EXPECT_NEAR(inside_volume(plc), 8000 - 14, 1e-9);
  EXPECT_EQ(inside_count(plc), 1u);
}

TEST(PlcRegions, CubesThatTouchInAnEdgeOrAVertexAreTwoRegions) {
  for (const double z : {0.0, 1.0}) {
    plc::InputPlc input = unit_cube();
    append(input, box({1, 1, z}, {2, 2, z + 1}));
    for (const Matrix& m : {rotation(1, 0, 0, 0), arbitrary}) {
      const plc::Plc plc = plc::build_plc(rotated(m, input));
      EXPECT_EQ(plc.vertices.size(), z == 0 ? 14u : 15u);
      EXPECT_EQ(plc.regions.size(), 3u);
      EXPECT_EQ(inside_count(plc), 2u);
      EXPECT_EQ(grazeable_count(plc), 0u);
      EXPECT_EQ(std::ranges::count(plc.segments, true, &plc::Segment::touching), z == 0 ? 1 : 0);
    }
  }
}

TEST(PlcRegions, AHoleThatTouchesTheSurfaceInAVertexIsStillAHole) {
  plc::InputPlc input = box({0, 0, 0}, {4, 4, 4});
  const auto first = static_cast<std::uint32_t>(input.vertices.size());
  for (const Point3& p : {Point3{0, 0, 0}, Point3{1, 2, 1}, Point3{2, 1, 1}, Point3{1, 1, 2}})
    input.vertices.push_back(p);
  for (const Triangle& t : std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}})
    input.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  const plc::Plc plc = plc::build_plc(input);
  EXPECT_EQ(plc.regions.size(), 3u);
  ASSERT_EQ(inside_count(plc), 1u);
  EXPECT_NEAR(inside_volume(plc), 64 - 4.0 / 6, 1e-12);
}

plc::InputPlc cube_with_dangling_facet() {
  plc::InputPlc input = box({0, 0, 0}, {4, 4, 4});
  input.inside = Inside::seeds;
  const auto first = static_cast<std::uint32_t>(input.vertices.size());
  for (const Point3& p : {Point3{1, 1, 2}, Point3{3, 1, 2}, Point3{3, 3, 2}, Point3{1, 3, 2}})
    input.vertices.push_back(p);
  append_fan(input, {first, first + 1, first + 2, first + 3});
  return input;
}

TEST(PlcRegions, ADanglingFacetHasTheSameRegionOnBothSides) {
  for (const Matrix& m : {rotation(1, 0, 0, 0), arbitrary}) {
    const plc::Plc plc = plc::build_plc(rotated(m, cube_with_dangling_facet()));
    EXPECT_EQ(plc.facets.size(), 7u);
    EXPECT_EQ(plc.segments.size(), 16u);
    EXPECT_EQ(grazeable_count(plc), 4u);
    EXPECT_EQ(plc.regions.size(), 2u);
    EXPECT_EQ(plc.facets.back().above, plc.facets.back().below);
    EXPECT_EQ(plc.facets.back().above, 1u);
  }
}

TEST(PlcRegions, DanglingSegmentsAreGrazeableInsideOnly) {
  plc::InputPlc input = unit_cube();
  input.vertices.insert(input.vertices.end(), {{0.2, 0.3, 0.4}, {0.6, 0.7, 0.5}, {1.5, 0.5, 0.5}});
  input.segments = {{8, 9}, {0, 8}, {7, 10}};  // within; from a corner inward; from a corner outward
  input.segment_markers = {1, 2, 3};
  const plc::Plc plc = plc::build_plc(input);
  ASSERT_EQ(plc.segments.size(), 15u);
  for (const plc::Segment& s : plc.segments) EXPECT_EQ(s.grazeable, s.marker == 1 || s.marker == 2);
}

TEST(PlcRegions, ASegmentIsSplitWhereAVertexLiesOnIt) {
  plc::InputPlc input = unit_cube();
  input.vertices.insert(input.vertices.end(), {{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}, {0.5, 0.5, 0.5}});
  input.segments = {{9, 8}};
  input.segment_markers = {4};
  const plc::Plc plc = plc::build_plc(input);
  ASSERT_EQ(plc.segments.size(), 14u);
  EXPECT_EQ(segment_ends(plc, true), (std::set<std::array<std::uint32_t, 2>>{{8, 10}, {9, 10}}));
}

// A facet from the top of a box down into it: its upper edge divides the top.
TEST(PlcRegions, TheEdgesOfASlitThatAreNotOnTheSurfaceAreGrazeable) {
  plc::InputPlc input;
  input.inside = Inside::seeds;
  input.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0},   {0, 2, 0},   {0, 0, 2},   {2, 0, 2},
                    {2, 2, 2}, {0, 2, 2}, {0.5, 1, 2}, {1.5, 1, 2}, {1.5, 1, 1}, {0.5, 1, 1}};
  for (const auto& q : std::vector<std::vector<std::uint32_t>>{
           {0, 3, 2, 1}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {8, 11, 10, 9}})
    append_fan(input, q);
  for (const Triangle& t : std::vector<Triangle>{{4, 5, 8}, {5, 9, 8}, {5, 6, 9}, {6, 7, 9}, {7, 8, 9}, {7, 4, 8}})
    input.triangles.push_back(t);
  for (const Matrix& m : {rotation(1, 0, 0, 0), arbitrary}) {
    const plc::Plc plc = plc::build_plc(rotated(m, input));
    EXPECT_EQ(plc.facets.size(), 7u) << "the top remains one facet with a segment in it";
    EXPECT_EQ(plc.segments.size(), 16u);
    EXPECT_EQ(plc.regions.size(), 2u);
    EXPECT_EQ(segment_ends(plc, true), (std::set<std::array<std::uint32_t, 2>>{{8, 11}, {9, 10}, {10, 11}}))
        << "the slit meets the top at right angles, twice 90 degrees";
  }
}

TEST(PlcRegions, SeedsOnAFacetAndThoseOfRegionsOutsideAreRejected) {
  for (const Point3& seed : {Point3{5, 0.5, 0.5}, Point3{0.5, 0.5, -1e300}, Point3{0.5, 0.25, 1}, Point3{0, 0.5, 0.5},
                             Point3{0, 0, 0}, Point3{0.5, 0, 0}}) {
    plc::InputPlc input = unit_cube();
    input.inside = Inside::seeds;
    input.regions = {{seed, 1, 0}};
    EXPECT_THROW(plc::build_plc(input), InputError);
    input.regions.clear();
    input.holes = {seed};
    const bool is_outside = seed.x == 5 || seed.z == -1e300;
    if (is_outside)
      EXPECT_EQ(plc::build_plc(input).idle_holes.size(), 1u);
    else
      EXPECT_THROW(plc::build_plc(input), InputError);
  }
}

TEST(PlcRegions, AHoleSeedOutsideTheSolidIsIdle) {
  plc::InputPlc input = l_shape();  // the seed is within the box of its vertices
  input.inside = Inside::seeds;
  input.holes = {{1.5, 1.5, 0.5}};
  const plc::Plc plc = plc::build_plc(input);
  EXPECT_EQ(plc.idle_holes, input.holes);
  EXPECT_TRUE(plc.regions.at(1).inside);
  input.regions = {{input.holes[0], 1, 0}};
  input.holes.clear();
  EXPECT_THROW(plc::build_plc(input), InputError);
}

TEST(PlcRegions, AHoleSeedMustLeaveSomething) {
  plc::InputPlc input = unit_cube();
  input.inside = Inside::seeds;
  input.holes = {{0.5, 0.5, 0.5}};
  EXPECT_THROW(plc::build_plc(input), InputError);
}

}  // namespace
}  // namespace ccdt
