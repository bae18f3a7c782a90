#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "engine/base/errors.h"
#include "engine/tests/shared/plc_test_solids.h"

namespace ccdt {
namespace {

using namespace plc_test;

struct InputFault {
  bool is_found = false;
  Place place = {};
  std::string what = {};  // for people
};

/// The error with which the input is rejected.
InputFault fault_of(const plc::InputPlc& input) {
  try {
    plc::build_plc(input);
  } catch (const InputError& error) {
    EXPECT_FALSE(error.remedy().empty());
    EXPECT_EQ(error.place().file, input.name);
    return {true, error.place(), error.what()};
  }
  return {};
}

std::vector<long long> numbers(std::initializer_list<long long> n) {
  return n;
}

TEST(PlcInputFaults, NoFacets) {
  plc::InputPlc input;
  input.vertices = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_TRUE(fault_of(input).is_found);
  EXPECT_TRUE(fault_of(plc::InputPlc{}).is_found);
}

TEST(PlcInputFaults, CoordinatesThatAreNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    plc::InputPlc input = unit_cube();
    input.vertices[5].y = bad;
    const InputFault fault = fault_of(input);
    EXPECT_TRUE(fault.is_found);
    EXPECT_NE(fault.what.find('5'), std::string::npos) << fault.what;
  }
}

TEST(PlcInputFaults, NoFacetWithAnArea) {
  plc::InputPlc input;
  input.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  input.triangles = {{0, 1, 2}, {0, 1, 1}};
  EXPECT_TRUE(fault_of(input).is_found);
}

TEST(PlcInputFaults, ADuplicateFacetByBothNumbers) {
  plc::InputPlc input = unit_cube();
  const auto [a, b, c] = input.triangles[4];
  input.triangles.push_back({b, a, c});
  const InputFault fault = fault_of(input);
  EXPECT_TRUE(fault.is_found);
  EXPECT_EQ(fault.place.facets, numbers({4, 12}));
}

TEST(PlcInputFaults, AnOpenSurfaceByItsLoops) {
  plc::InputPlc input = gridded_cube(4);
  input.triangles.erase(input.triangles.begin() + 130);  // on another face
  input.triangles.erase(input.triangles.begin() + 10, input.triangles.begin() + 12);
  const InputFault fault = fault_of(input);
  EXPECT_TRUE(fault.is_found);
  EXPECT_EQ(fault.place.points.size(), 2u);
}

TEST(PlcInputFaults, APlcThatEnclosesNothing) {
  plc::InputPlc input = unit_cube();
  input.inside = plc::InputPlc::Inside::seeds;
  input.triangles.pop_back();
  EXPECT_TRUE(fault_of(input).is_found);
}

TEST(PlcInputFaults, CrossingBoxesByTheirFacetsAndAPoint) {
  for (const Matrix& m : {rotation(1, 0, 0, 0), arbitrary}) {
    plc::InputPlc input = box({0, 0, 0}, {4, 4, 4});
    append(input, box({3, 1, 1}, {5, 2, 2}));
    const InputFault fault = fault_of(rotated(m, input));
    EXPECT_TRUE(fault.is_found);
    ASSERT_EQ(fault.place.facets.size(), 2u);
    EXPECT_LT(fault.place.facets[0], 12);
    EXPECT_GE(fault.place.facets[1], 12);
    ASSERT_EQ(fault.place.points.size(), 1u);
    const auto [x, y, z] = fault.place.points[0];
    const Point3 back = rotated(
        {{{m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}}}, Point3{x, y, z});
    EXPECT_NEAR(back.x, 4, 1e-6);
    EXPECT_TRUE(back.y > 1 - 1e-6 && back.y < 2 + 1e-6 && back.z > 1 - 1e-6 && back.z < 2 + 1e-6);
  }
}

TEST(PlcInputFaults, ACornerThatPiercesAFacet) {
  plc::InputPlc input = unit_cube();
  append(input, schoenhardt());
  for (std::size_t v = 8; v < 14; ++v) input.vertices[v] = input.vertices[v] + Point3{0.5, 0.6, 0.7};
  EXPECT_TRUE(fault_of(input).is_found);
}

TEST(PlcInputFaults, TrianglesThatShareACornerAndCross) {
  plc::InputPlc input;
  input.inside = plc::InputPlc::Inside::seeds;
  input.vertices = {{0, 0, 0}, {4, -1, 0}, {4, 1, 0}, {3, 0, -1}, {3, 0, 1}};
  input.triangles = {{0, 1, 2}, {0, 3, 4}};
  const InputFault fault = fault_of(input);
  EXPECT_TRUE(fault.is_found);
  EXPECT_EQ(fault.place.facets, numbers({0, 1}));
  ASSERT_EQ(fault.place.points.size(), 1u);
  EXPECT_NEAR(fault.place.points[0][0], 3, 1e-6);
}

// Two squares over the same four corners, with different diagonals.
TEST(PlcInputFaults, FacetsThatCoverEachOther) {
  for (const Matrix& m : {rotation(1, 0, 0, 0), arbitrary, rotation(3, 1, -2, 5)}) {
    plc::InputPlc input = unit_cube();
    const auto [a, b, c] = input.triangles[0];
    const VertexId d(input.triangles[1][2]);
    input.triangles.push_back({a, b, d});
    input.triangles.push_back({b, c, d});
    const InputFault fault = fault_of(rotated(m, input));
    EXPECT_TRUE(fault.is_found);
    ASSERT_EQ(fault.place.facets.size(), 2u);
    EXPECT_LT(fault.place.facets[0], 2);
    EXPECT_GE(fault.place.facets[1], 12);
    EXPECT_EQ(fault.place.points.size(), 1u);
  }
}

TEST(PlcInputFaults, FacetsThatCoverEachOtherInPart) {
  plc::InputPlc input = box({0, 0, 0}, {4, 4, 4});
  append(input, box({4, 1, 1}, {6, 2, 2}));  // stands on the first one's side without being cut out of it
  const InputFault fault = fault_of(input);
  EXPECT_TRUE(fault.is_found);
  ASSERT_EQ(fault.place.points.size(), 1u);
  EXPECT_NEAR(fault.place.points[0][0], 4, 1e-9);
}

TEST(PlcInputFaults, ASegmentThatCrossesAFacet) {
  plc::InputPlc input = unit_cube();
  input.vertices.insert(input.vertices.end(), {{0.5, 0.25, 0.5}, {0.5, 0.25, 2}});
  input.segments = {{8, 9}};
  const InputFault fault = fault_of(input);
  EXPECT_TRUE(fault.is_found);
  ASSERT_EQ(fault.place.points.size(), 3u);
  EXPECT_NEAR(fault.place.points[0][2], 1, 1e-9);
}

TEST(PlcInputFaults, SegmentsThatCross) {
  plc::InputPlc input = unit_cube();
  input.vertices.insert(input.vertices.end(), {{0.2, 0.2, 0.5}, {0.8, 0.8, 0.5}, {0.8, 0.2, 0.5}, {0.2, 0.8, 0.5}});
  input.segments = {{8, 9}, {10, 11}};
  const InputFault fault = fault_of(input);
  EXPECT_TRUE(fault.is_found);
  ASSERT_EQ(fault.place.points.size(), 5u);
  EXPECT_NEAR(fault.place.points[0][0], 0.5, 1e-9);
}

TEST(PlcInputFaults, FacetsThatAreNearButApartAreAccepted) {
  plc::InputPlc input = box({0, 0, 0}, {4, 4, 4});
  append(input, box({4.000001, 1, 1}, {6, 2, 2}));
  const plc::Plc plc = plc::build_plc(input);
  EXPECT_EQ(inside_count(plc), 2u);
}

}  // namespace
}  // namespace ccdt
