#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>

#include "engine/base/errors.h"
#include "engine/plc/build_plc.h"
#include "engine/plc/warped_facets.h"
#include "engine/repair/find_faults.h"
#include "engine/tests/repair/repair_cases.h"

namespace ccdt {
namespace {

using namespace plc_test;
using repair::Diagnosis;
using repair::FaultKind;

const repair::Fault* find(const Diagnosis& diagnosis, FaultKind kind) {
  const auto found = std::ranges::find(diagnosis.faults, kind, &repair::Fault::kind);
  return found == diagnosis.faults.end() ? nullptr : &*found;
}

/// How many faults of this kind there are, if they are the only errors.
std::uint64_t only_error(const plc::InputPlc& input, FaultKind kind) {
  const Diagnosis diagnosis = repair::find_faults(input);
  EXPECT_FALSE(diagnosis.is_valid());
  for (const repair::Fault& fault : diagnosis.faults) EXPECT_EQ(fault.is_error, fault.kind == kind);
  const repair::Fault* fault = find(diagnosis, kind);
  return fault == nullptr ? 0 : fault->count;
}

/// The same for a fault of a valid input.
std::uint64_t noted(const plc::InputPlc& input, FaultKind kind) {
  const Diagnosis diagnosis = repair::find_faults(input);
  EXPECT_TRUE(diagnosis.is_valid());
  const repair::Fault* fault = find(diagnosis, kind);
  return fault == nullptr ? 0 : fault->count;
}

TEST(Faults, ACubeHasNone) {
  const Diagnosis diagnosis = repair::find_faults(unit_cube());
  EXPECT_TRUE(diagnosis.is_valid());
  EXPECT_TRUE(diagnosis.faults.empty());
  EXPECT_EQ(diagnosis.facets, 12u);
  EXPECT_EQ(diagnosis.regions, 1u);
  EXPECT_DOUBLE_EQ(diagnosis.volume, 1);
}

TEST(Faults, TheVolumeIsThatOfAnEqualPartAtTheOrigin) {
  plc::InputPlc input = unit_cube();
  for (Point3& p : input.vertices) p = p + Point3{441871, 6329700, -1200};
  EXPECT_DOUBLE_EQ(repair::find_faults(input).volume, 1);
}

TEST(Faults, CoordinatesThatAreNotFinite) {
  plc::InputPlc input = unit_cube();
  input.vertices[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(only_error(input, FaultKind::coordinates), 1u);
}

TEST(Faults, NoFacets) {
  plc::InputPlc input = unit_cube();
  input.triangles.clear();
  EXPECT_EQ(only_error(input, FaultKind::no_facets), 1u);
  input.triangles = {{0, 0, 1}, {2, 3, 3}};
  EXPECT_EQ(only_error(input, FaultKind::no_facets), 1u);
}

TEST(Faults, PolygonsThatAreNone) {
  plc::InputPlc input = unit_cube();
  input.vertices.insert(input.vertices.end(), {{2, 0, 0}, {3, 1, 0}, {3, 0, 0}, {2, 1, 0}});
  input.polygon_facets = {{{{8, 9, 10, 11}}, {}, 0, 12}};  // its edges cross
  const Diagnosis diagnosis = repair::find_faults(input);
  ASSERT_NE(find(diagnosis, FaultKind::polygons), nullptr);
  EXPECT_EQ(find(diagnosis, FaultKind::polygons)->count, 1u);
  EXPECT_EQ(find(diagnosis, FaultKind::polygons)->places[0].facets, std::vector<long long>{12});
}

TEST(Faults, AllHolesWithTheirRims) {
  plc::InputPlc input = gridded_cube(4);
  merge_equal_vertices(input);
  input.triangles.erase(input.triangles.begin() + 40);
  input.triangles.erase(input.triangles.begin() + 8, input.triangles.begin() + 10);  // a square
  EXPECT_EQ(only_error(input, FaultKind::open_edges), 2u);
  const Diagnosis diagnosis = repair::find_faults(input);
  std::vector<std::size_t> rims;
  for (const Place& place : find(diagnosis, FaultKind::open_edges)->places) rims.push_back(place.points.size());
  EXPECT_EQ(rims, (std::vector<std::size_t>{4, 3}));
}

TEST(Faults, DuplicatesWithTheFacetsThatAreEqual) {
  plc::InputPlc input = unit_cube();
  input.triangles.push_back({input.triangles[5][2], input.triangles[5][0], input.triangles[5][1]});
  input.triangles.push_back(input.triangles[5]);
  EXPECT_EQ(only_error(input, FaultKind::duplicate_facets), 2u);
  const Diagnosis diagnosis = repair::find_faults(input);
  EXPECT_EQ(find(diagnosis, FaultKind::duplicate_facets)->places[1].facets, (std::vector<long long>{5, 13}));
}

TEST(Faults, CrossingFacetsAndWhere) {
  plc::InputPlc input = unit_cube();
  append(input, box({0.5, 0.25, 0.25}, {2, 0.75, 0.75}));
  EXPECT_GE(only_error(input, FaultKind::crossing_facets), 4u);
  const Diagnosis diagnosis = repair::find_faults(input);
  for (const Place& place : find(diagnosis, FaultKind::crossing_facets)->places) EXPECT_EQ(place.points[0][0], 1);
}

TEST(Faults, CoveringFacets) {
  plc::InputPlc input = unit_cube();
  append(input, box({1, 0.25, 0.3}, {2, 0.75, 1.5}));  // its edges also cross the cube's
  const Diagnosis diagnosis = repair::find_faults(input);
  ASSERT_NE(find(diagnosis, FaultKind::covering_facets), nullptr);
  EXPECT_TRUE(find(diagnosis, FaultKind::covering_facets)->is_error);
}

TEST(Faults, CrossingSegments) {
  plc::InputPlc input = unit_cube();
  input.inside = plc::InputPlc::Inside::seeds;
  input.vertices.insert(input.vertices.end(), {{0.3, 0.6, 0.5}, {0.3, 0.6, 2}});
  input.segments = {{8, 9}};
  EXPECT_EQ(only_error(input, FaultKind::crossing_segments), 1u);
}

TEST(Faults, SeedsOutside) {
  plc::InputPlc input = unit_cube();
  input.inside = plc::InputPlc::Inside::seeds;
  input.regions = {{{5, 5, 5}, 1, 0}};
  EXPECT_EQ(only_error(input, FaultKind::domain), 1u);
  input.regions.clear();
  input.holes = {{5, 5, 5}};
  EXPECT_EQ(noted(input, FaultKind::idle_holes), 1u);
}

TEST(Faults, NotesOnTheFile) {
  plc::InputPlc input = unit_cube();
  input.notes = {"one", "two"};
  EXPECT_EQ(noted(input, FaultKind::unusual_file), 2u);
  EXPECT_EQ(find(repair::find_faults(input), FaultKind::unusual_file)->detail, "one; two");
}

TEST(Faults, ADanglingFacetOfAPlcIsNotOne) {
  plc::InputPlc input = unit_cube();
  input.vertices.insert(input.vertices.end(), {{0.2, 0.2, 0.5}, {0.8, 0.2, 0.5}, {0.5, 0.8, 0.5}});
  input.triangles.push_back({8, 9, 10});
  EXPECT_EQ(only_error(input, FaultKind::open_edges), 1u);
  input.inside = plc::InputPlc::Inside::seeds;
  EXPECT_EQ(noted(input, FaultKind::open_edges), 1u);
}

TEST(Faults, WhatTheMesherCopesWith) {
  plc::InputPlc input = unit_cube();
  input.triangles.push_back({0, 1, 1});
  EXPECT_EQ(noted(input, FaultKind::facets_without_area), 1u);
  input = unit_cube();
  input.vertices.insert(input.vertices.end(), {input.vertices[7], {0.5, 0.5, 0.5}});
  EXPECT_EQ(noted(input, FaultKind::equal_vertices), 1u);
  EXPECT_EQ(noted(input, FaultKind::unused_vertices), 1u);
  input = unit_cube();
  std::swap(input.triangles[3][0], input.triangles[3][1]);
  EXPECT_EQ(noted(input, FaultKind::turned_edges), 3u);
  EXPECT_EQ(noted(input, FaultKind::inward_facets), 1u);
  input = unit_cube();
  for (auto& corners : input.triangles) std::swap(corners[0], corners[1]);
  EXPECT_EQ(noted(input, FaultKind::turned_edges), 0u);
  EXPECT_EQ(noted(input, FaultKind::inward_facets), 12u);
}

TEST(Faults, FacetsWithAVertexOnThem) {
  plc::InputPlc input = unit_cube();  // its side x = 1 is that of two boxes, which split both of its triangles
  append(input, box({1, 0, 0}, {2, 1, 0.5}));
  append(input, box({1, 0, 0.5}, {2, 1, 1}));
  const Diagnosis diagnosis = repair::find_faults(input);
  ASSERT_NE(find(diagnosis, FaultKind::split_facets), nullptr);
  EXPECT_EQ(find(diagnosis, FaultKind::split_facets)->count, 4u);  // and one triangle at each end of the new edge
}

TEST(Faults, EdgesOfSeveralFacets) {
  plc::InputPlc input = unit_cube();
  append(input, box({1, 1, 0}, {2, 2, 1}));
  EXPECT_EQ(noted(input, FaultKind::shared_edges), 1u);
}

TEST(Faults, AnInputIsValidExactlyIfThePlcIs) {
  std::mt19937_64 random(2006);
  int valid = 0, wrong = 0;
  for (int i = 0; i < 2000; ++i) {
    const plc::InputPlc input = damaged_solid(random);
    bool is_plc = true;
    try {
      plc::build_plc(plc::triangulate_warped_facets(input).value_or(input));
    } catch (const InputError&) {
      is_plc = false;
    }
    valid += is_plc;
    wrong += repair::find_faults(input).is_valid() != is_plc;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(valid, 200);
  EXPECT_LT(valid, 1800);
}

}  // namespace
}  // namespace ccdt
