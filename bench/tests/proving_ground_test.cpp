#include <gtest/gtest.h>

#include <algorithm>

#include "bench/proving_ground/prove.h"
#include "bench/proving_ground/scene.h"
#include "bench/proving_ground/structured_plc.h"

namespace ccdt {
namespace {

using namespace proving_ground;
using Outcome = Proof::Outcome;

InputPlc box() {
  Random random(1);
  Scene scene(random);
  scene.add(box_body);
  return scene.plc();
}

TEST(ProvingGround, AllStrategiesAgreeOnStructuredPlcsAndTheirMeshesAreRight) {
  int right = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Proof proof = prove(structured_plc(seed), {.seconds = 600});
    EXPECT_TRUE(proof.outcome == Outcome::right || proof.outcome == Outcome::invalid)
        << "seed " << seed << ": " << proof.what;
    right += proof.outcome == Outcome::right;
  }
  EXPECT_GT(right, 250) << "most are valid";
}

TEST(ProvingGround, SeedsThatHaveFailedAreRight) {
  // Facets about as narrow as the tolerance.
  for (const std::uint64_t seed : {1618, 1890, 2768, 2986, 3395}) {
    const Proof proof = prove(structured_plc(seed), {.seconds = 600});
    EXPECT_EQ(proof.outcome, Outcome::right) << "seed " << seed << ": " << proof.what;
  }
}

TEST(ProvingGround, ASeedGivesOnePlc) {
  const InputPlc a = structured_plc(7), b = structured_plc(7), c = structured_plc(8);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.segments, b.segments);
  EXPECT_NE(a.vertices, c.vertices);
}

TEST(ProvingGround, ThingsThatTheInputCheckRefusesLeaveNothingBehind) {
  Random random(1);
  Scene scene(random);
  ASSERT_TRUE(scene.add(box_body));
  const InputPlc before = scene.plc();
  EXPECT_FALSE(scene.add([](Scene& s) { s.facet({{8, 8, 8}, {8, 8, 32}, {8, 16, 8}}); }));
  EXPECT_EQ(scene.plc().vertices, before.vertices);
  EXPECT_EQ(scene.plc().polygon_facets.size(), before.polygon_facets.size());
}

TEST(ProvingGround, AnEdgeOnAFacetIsDrawnInIt) {
  Random random(1);
  Scene scene(random);
  ASSERT_TRUE(scene.add(box_body));
  ASSERT_TRUE(scene.add([](Scene& s) { s.facet({{2, 3, 0}, {9, 12, 0}, {5, 5, 5}}); }));
  EXPECT_EQ(scene.plc().polygon_facets[4].polygons.size(), 2u);
  EXPECT_EQ(prove(scene.plc()).outcome, Outcome::right);
}

TEST(ProvingGround, AnOpenSurfaceIsInvalid) {
  InputPlc open = box();
  open.polygon_facets.pop_back();
  EXPECT_EQ(prove(open).outcome, Outcome::invalid);
}

TEST(ProvingGround, NoMeshTakesNoTime) {
  const Proof proof = prove(box(), {.seconds = 0});
  EXPECT_EQ(proof.outcome, Outcome::endless);
  EXPECT_FALSE(proof.what.empty());
}

TEST(ProvingGround, WhatIsInterestingIsLeft) {
  InputPlc plc = structured_plc(3);
  plc.vertices.insert(plc.vertices.end(), {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
  const auto n = static_cast<std::uint32_t>(plc.vertices.size());
  plc.segments.insert(plc.segments.end(), {{n - 3, n - 2}, {n - 2, n - 1}});
  const InputPlc least = reduce(plc, [](const InputPlc& smaller) {
    return std::ranges::any_of(smaller.segments, [&](const auto& s) {
      return smaller.vertices[s[0]] == Point3{4, 5, 6};
    });
  });
  EXPECT_EQ(least.vertices, (std::vector<Point3>{{4, 5, 6}, {7, 8, 9}}));
  EXPECT_EQ(least.segments.size(), 1u);
  EXPECT_TRUE(least.polygon_facets.empty());
}

}  // namespace
}  // namespace ccdt
