#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string_view>

#include "engine/base/errors.h"
#include "engine/repair/find_faults.h"
#include "engine/repair/repair_input.h"
#include "engine/tests/repair/repair_cases.h"
#include "models/solids.h"

namespace ccdt {
namespace {

using namespace plc_test;
using repair::Diagnosis;
using repair::FaultKind;

std::uint64_t count_of(const repair::Repaired& repaired, std::string_view name) {
  for (const repair::RepairStep& step : repaired.steps)
    if (step.name == name) return step.count;
  return 0;
}

/// Repairs an input; the result must be valid, with this volume, and a second repair must find nothing to do.
repair::Repaired repaired(const plc::InputPlc& input, double volume, double tolerance = 1e-9,
                          const repair::RepairOptions& options = {}) {
  repair::Repaired result = repair::repair_input(input, options);
  const Diagnosis diagnosis = repair::find_faults(result.input, options.flatness);
  EXPECT_TRUE(diagnosis.is_valid());
  EXPECT_NEAR(diagnosis.volume, volume, tolerance * std::fabs(volume));
  for (const repair::Fault& fault : diagnosis.faults) EXPECT_EQ(fault.kind, FaultKind::shared_edges);
  EXPECT_TRUE(repair::repair_input(result.input, options).steps.empty());
  return result;
}

/// Each coordinate moves by up to this much.
void shake(std::mt19937_64& random, double size, plc::InputPlc& input) {
  std::uniform_real_distribution<double> step(-size, size);
  for (Point3& p : input.vertices) p = p + Point3{step(random), step(random), step(random)};
}

TEST(Repair, LeavesAValidInputAsItIs) {
  const repair::Repaired result = repaired(unit_cube(), 1);
  EXPECT_TRUE(result.steps.empty());
  EXPECT_EQ(result.input.vertices, unit_cube().vertices);
  EXPECT_EQ(result.input.triangles, unit_cube().triangles);
}

TEST(Repair, JoinsSeparateTrianglesWhoseCornersDiffer) {
  plc::InputPlc input = models::make_solid("sphere", 0.1);
  const double volume = repair::find_faults(input).volume;
  separate_triangles(input);
  std::mt19937_64 random(1);
  shake(random, 2e-5, input);
  const repair::Repaired result = repaired(input, volume, 1e-3);
  EXPECT_GT(count_of(result, "merged_vertices"), 1000u);
  EXPECT_EQ(result.input.triangles.size(), input.triangles.size());
}

TEST(Repair, ClosesGapsUpToTheGivenWidth) {
  plc::InputPlc input = gridded_cube(3);
  merge_equal_vertices(input);
  const std::uint32_t corner = input.triangles[0][0];
  input.vertices.push_back(input.vertices[corner] + Point3{0.01, 0, 0});
  input.triangles[0][0] = static_cast<std::uint32_t>(input.vertices.size() - 1);
  EXPECT_EQ(count_of(repair::repair_input(input), "merged_vertices"), 0u);
  EXPECT_EQ(count_of(repaired(input, 1, 1e-9, {.gap = 0.02}), "merged_vertices"), 1u);
}

TEST(Repair, SplitsAnEdgeAtAVertexBesideIt) {
  // A side of the cube has a vertex more in the middle of an edge, a little away from it.
  plc::InputPlc input = unit_cube();
  const auto [a, b, c] = input.triangles[0];
  input.vertices.push_back(0.5 * (input.vertices[a] + input.vertices[b]) + Point3{1e-5, 1e-5, 1e-5});
  input.triangles[0] = {a, 8, c};
  input.triangles.push_back({8, b, c});
  const repair::Repaired result = repaired(input, 1, 1e-4);
  EXPECT_EQ(count_of(result, "split_edges"), 1u);
  EXPECT_EQ(result.input.triangles.size(), 14u);
}

TEST(Repair, FillsHoles) {
  plc::InputPlc input = gridded_cube(5);
  merge_equal_vertices(input);
  // A whole side and two triangles of the opposite one.
  input.triangles.erase(input.triangles.begin(), input.triangles.begin() + 50);
  input.triangles.erase(input.triangles.begin() + 20, input.triangles.begin() + 22);
  EXPECT_EQ(count_of(repaired(input, 1, 1e-9, {.limit = 1}), "filled_holes"), 2u);
  EXPECT_EQ(count_of(repaired(rotated(arbitrary, input), 1, 1e-9, {.limit = 1}), "filled_holes"), 2u);
}

TEST(Repair, LeavesAHoleOpenWhoseLidWouldReachTooFar) {
  plc::InputPlc input = gridded_cube(5);
  merge_equal_vertices(input);
  input.triangles.erase(input.triangles.begin(), input.triangles.begin() + 50);  // a whole side
  const repair::Repaired refused = repair::repair_input(input);
  EXPECT_EQ(refused.refused.size(), 1u);
  EXPECT_EQ(count_of(refused, "filled_holes"), 0u);
  EXPECT_FALSE(repair::repair_input(input, {.limit = 0.49}).refused.empty());
  const repair::Repaired filled = repaired(input, 1, 1e-9, {.limit = 0.56});
  EXPECT_NEAR(filled.certificate.farthest_lid, 0.5, 0.056);
  EXPECT_GE(filled.certificate.farthest_lid, 0.5);
  EXPECT_NEAR(filled.certificate.largest_lid, 1, 1e-9);
  EXPECT_NEAR(filled.certificate.area_of_lids, 1, 1e-9);
  EXPECT_EQ(filled.certificate.displacement, 0);
}

TEST(Repair, BoundsHowFarTheSurfaceMoves) {
  plc::InputPlc input = unit_cube();
  separate_triangles(input);
  std::mt19937_64 random(3);
  shake(random, 1e-5, input);
  const repair::Certificate certificate = repaired(input, 1, 1e-3).certificate;
  EXPECT_GT(certificate.displacement, 1e-6);
  EXPECT_LT(certificate.displacement, 4e-5);
  EXPECT_EQ(certificate.components_before, 12u);
  EXPECT_EQ(certificate.components_after, 1u);
  EXPECT_EQ(certificate.genus, 0);
}

TEST(Repair, MeasuresTheUnionOfTwoCubes) {
  plc::InputPlc input = unit_cube();
  append(input, box({0.5, 0.25, 0.25}, {1.5, 0.75, 0.75}));
  const repair::Certificate certificate = repaired(input, 1.125).certificate;
  EXPECT_EQ(certificate.displacement, 0);
  EXPECT_NEAR(certificate.area_before, 6 + 2.5, 1e-9);
  EXPECT_NEAR(certificate.area_after, 6 + 1, 1e-9);
  EXPECT_NEAR(certificate.area_removed, 1.5, 1e-9);
  EXPECT_NEAR(certificate.volume_before.value(), 1.25, 1e-9);
}

TEST(Repair, RemovesASmallSheetBesideASolid) {
  plc::InputPlc input = unit_cube();
  const auto first = static_cast<std::uint32_t>(input.vertices.size());
  for (const Point3& p : {Point3{0.4, 0.4, 0.5}, {0.5, 0.4, 0.52}, {0.5, 0.5, 0.5}, {0.4, 0.5, 0.52}})
    input.vertices.push_back(p);
  input.triangles.push_back({first, first + 1, first + 2});
  input.triangles.push_back({first, first + 2, first + 3});
  EXPECT_EQ(count_of(repaired(input, 1), "sheets"), 2u);
}

TEST(Repair, RefusesAFlatSheetAtOnce) {
  plc::InputPlc input = gridded_cube(40);
  merge_equal_vertices(input);
  input.triangles.resize(3200);  // one side
  EXPECT_THROW(repair::repair_input(input), InputError);
}

TEST(Repair, EndsInTime) {
  plc::InputPlc input = models::make_solid("sphere", 0.2);
  append(input, rotated(arbitrary, input));
  EXPECT_TRUE(repair::repair_input(input, {.seconds = 1e-9}).is_out_of_time);
  EXPECT_FALSE(repair::repair_input(input).is_out_of_time);
}

TEST(Repair, FillsHolesOfCurvedSurfaces) {
  plc::InputPlc input = models::make_solid("sphere", 0.1);
  const double volume = repair::find_faults(input).volume;
  std::mt19937_64 random(2);
  std::erase_if(input.triangles, [&](const auto&) { return random() % 20 == 0; });
  input.triangle_markers.clear();
  EXPECT_GT(count_of(repaired(input, volume, 1e-2, {.limit = 1}), "filled_holes"), 20u);
}

TEST(Repair, RemovesFlaps) {
  plc::InputPlc input = gridded_cube(4);
  merge_equal_vertices(input);
  const auto [a, b, c] = input.triangles[0];
  input.vertices.push_back({0.5, 0.5, 3});
  input.triangles.push_back({a, b, static_cast<std::uint32_t>(input.vertices.size() - 1)});
  EXPECT_EQ(count_of(repaired(input, 1), "flaps"), 1u);
}

TEST(Repair, RemovesWhatBoundsNothing) {
  plc::InputPlc input = unit_cube();
  input.vertices.push_back({9, 9, 9});
  input.triangles.push_back({0, 0, 1});
  input.triangles.push_back({input.triangles[2][1], input.triangles[2][2], input.triangles[2][0]});
  const repair::Repaired result = repaired(input, 1);
  EXPECT_EQ(count_of(result, "without_area"), 1u);
  EXPECT_EQ(count_of(result, "duplicates"), 1u);
  EXPECT_EQ(result.input.vertices.size(), 8u);
  EXPECT_EQ(result.input.triangles.size(), 12u);
}

TEST(Repair, TurnsFacetsOutward) {
  plc::InputPlc input = unit_cube();
  append(input, box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}));  // a cavity, whose facets should face its middle
  for (const std::size_t t : {1, 4, 7}) std::swap(input.triangles[t][0], input.triangles[t][1]);
  const repair::Repaired result = repaired(input, 1 - 0.125);
  EXPECT_EQ(count_of(result, "turned_facets"), 3u + 12u);
}

TEST(Repair, UnitesSolidsThatOverlap) {
  plc::InputPlc input = unit_cube();
  append(input, box({0.5, 0.25, 0.125}, {2, 0.75, 0.5}));
  const repair::Repaired result = repaired(input, 1 + 1.0 * 0.5 * 0.375);
  EXPECT_GT(count_of(result, "crossings"), 0u);
  EXPECT_GT(count_of(result, "walls"), 0u);
  EXPECT_EQ(repair::find_faults(result.input).regions, 1u);
}

TEST(Repair, UnitesTurnedSolids) {
  plc::InputPlc input = models::make_solid("torus", 0.15);
  const double volume = repair::find_faults(input).volume;
  plc::InputPlc other = rotated(arbitrary, input);
  append(input, other);
  input.triangle_markers.clear();
  const repair::Repaired result = repair::repair_input(input);
  const Diagnosis diagnosis = repair::find_faults(result.input);
  EXPECT_TRUE(diagnosis.is_valid());
  EXPECT_LT(diagnosis.volume, 2 * volume);
  EXPECT_GT(diagnosis.volume, 1.2 * volume);
  EXPECT_EQ(diagnosis.regions, 1u);
}

TEST(Repair, KeepsTheWallBetweenSolidsThatTouch) {
  plc::InputPlc input = unit_cube();
  append(input, box({1, 0.25, 0.25}, {2, 0.75, 0.75}));
  const repair::Repaired result = repaired(input, 1.25);
  EXPECT_EQ(count_of(result, "walls"), 0u);
  EXPECT_EQ(repair::find_faults(result.input).regions, 2u);
}

TEST(Repair, JoinsTurnedSolidsThatTouchWithinTheRoundingOfSinglePrecision) {
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    plc::InputPlc input = box({0, 0, 0}, {10, 10, 10});
    append(input, box({10, 2, 3}, {17, 8, 9}));
    append(input, box({2, 2, 10}, {5, 12, 14}));
    input = rotated(rotation(1, 0.1 * i, 0.7 - 0.02 * i, 0.3), input);
    for (Point3& p : input.vertices) p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    const repair::Repaired result = repaired(input, 1000 + 7 * 6 * 6 + 3 * 10 * 4, 1e-5);
    EXPECT_EQ(repair::find_faults(result.input).regions, 3u);
  }
}

/// The digits of a file round more than the tolerance for flat facets.
TEST(Repair, JoinsTurnedSolidsOfAFileWithFewDigits) {
  for (int i = 0; i < 6; ++i) {
    SCOPED_TRACE(i);
    plc::InputPlc input = box({0, 0, 0}, {3, 3, 3});
    append(input, box({2, 1, 1}, {5, 4, 2}));
    append(input, box({1, 1, 0}, {4, 2, 3}));
    append(input, box({0, 2, 3}, {3, 4, 4}));
    input = rotated(rotation(1, 0.1 * i, 0.7 - 0.02 * i, 0.3), input);
    for (Point3& p : input.vertices)
      p = {1e-6 * std::round(1e6 * p.x), 1e-6 * std::round(1e6 * p.y), 1e-6 * std::round(1e6 * p.z)};
    const repair::Repaired result = repair::repair_input(input);
    const Diagnosis diagnosis = repair::find_faults(result.input);
    EXPECT_TRUE(diagnosis.is_valid());
    EXPECT_TRUE(result.refused.empty());
    EXPECT_NEAR(diagnosis.volume, 27 + (9 - 2) + 2 + 6, 1e-4);
    EXPECT_LT(result.certificate.displacement, 5e-6);
  }
}

TEST(Repair, MergesCopiesThatAlmostCoverEachOther) {
  for (const double shift : {1e-9, 1e-8}) {
    SCOPED_TRACE(shift);
    plc::InputPlc input = models::make_solid("sphere", 0.2);
    input.triangle_markers.clear();
    plc::InputPlc copy = input;
    for (Point3& p : copy.vertices) p = p + Point3{shift, shift / 3, -shift / 2};
    append(input, copy);
    EXPECT_TRUE(repair::find_faults(repair::repair_input(input, {.limit = 10}).input).is_valid());
  }
}

TEST(Repair, LeavesAHollowBetweenOverlappingSolids) {
  // Six slabs that overlap at their rims enclose a box of 2 x 2 x 2.
  plc::InputPlc input = box({-1.5, -1.5, -1.5}, {1.5, 1.5, -1});
  append(input, box({-1.4, -1.4, 1}, {1.4, 1.4, 1.75}));
  append(input, box({-1.6, -1.2, -1.1}, {-1, 1.3, 1.6}));
  append(input, box({1, -1.3, -1.2}, {1.7, 1.2, 1.5}));
  append(input, box({-1.3, -1.45, -1.3}, {1.25, -1, 1.3}));
  append(input, box({-1.25, 1, -1.4}, {1.35, 1.65, 1.4}));
  const repair::Repaired result = repair::repair_input(input);
  const Diagnosis diagnosis = repair::find_faults(result.input);
  EXPECT_TRUE(diagnosis.is_valid());
  EXPECT_EQ(diagnosis.regions, 1u);
  // A point in the hollow is outside: seen from there, all facets face it.
  double least = 1;
  for (const auto& [a, b, c] : result.input.triangles) {
    const auto& v = result.input.vertices;
    const Point3 middle = (1.0 / 3) * (v[a] + v[b] + v[c]);
    if (std::max({std::fabs(middle.x), std::fabs(middle.y), std::fabs(middle.z)}) > 1.0001) continue;
    least = std::min(least, dot(area_vector({v[a], v[b], v[c]}), Point3{} - middle));
  }
  EXPECT_GT(least, 0);
  EXPECT_LT(least, 1);
}

TEST(Repair, KeepsMarkersSegmentsAndSeedsOfAPlc) {
  plc::InputPlc input = unit_cube();
  input.inside = plc::InputPlc::Inside::seeds;
  append(input, box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}));
  input.triangle_markers.assign(24, 3);
  input.holes = {{0.5, 0.5, 0.5}};
  input.vertices.insert(input.vertices.end(), {{0.1, 0.1, 0.1}, {0.2, 0.1, 0.1}, {0.9, 0.9, 0.9}});
  input.segments = {{16, 17}};
  input.segment_markers = {7};
  input.triangles.push_back(input.triangles[0]);
  input.triangle_markers.push_back(3);
  const repair::Repaired result = repair::repair_input(input);
  EXPECT_TRUE(repair::find_faults(result.input).is_valid());
  EXPECT_EQ(result.input.triangle_markers, std::vector<int>(24, 3));
  EXPECT_EQ(result.input.segment_markers, std::vector<int>{7});
  EXPECT_EQ(result.input.segments, input.segments);
  EXPECT_EQ(result.input.holes, input.holes);
  EXPECT_EQ(result.input.vertices.size(), 19u);
}

TEST(Repair, RefusesSheetsThatEncloseNothing) {
  plc::InputPlc input;
  input.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 0, 0}, {4, 1, 0}};
  input.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_THROW(repair::repair_input(input), InputError);
}

TEST(Repair, OfDamagedSolidsGivesValidOnes) {
  std::mt19937_64 random(2007);
  int damaged = 0, valid = 0;
  for (int i = 0; i < 1000; ++i) {
    const plc::InputPlc input = damaged_solid(random);
    if (repair::find_faults(input).is_valid()) continue;
    ++damaged;
    valid += repair::find_faults(repair::repair_input(input, {.limit = 10}).input).is_valid();
  }
  EXPECT_GT(damaged, 300);
  // What was meant is not always known: a facet may have a corner anywhere.
  EXPECT_LE(damaged - valid, 1);
}

}  // namespace
}  // namespace ccdt
