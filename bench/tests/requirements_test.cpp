#include "bench/run/requirements.h"

#include <gtest/gtest.h>

namespace ccdt::bench {
namespace {

TEST(RequirementsOfSurfaces, ADeviationAboveTheRequiredOneIsMissed) {
  const surface::SurfaceChange change{.distance = 0.02, .farthest = {1, 2, 3}};
  Requirements required;
  required.deviation = 0.02;
  EXPECT_TRUE(find_missed(required, {}, change).empty());
  required.deviation = 0.01;
  EXPECT_TRUE(find_missed(required, {}, {}).empty()) << "there is no new surface";
  const auto missed = find_missed(required, {}, change);
  ASSERT_EQ(missed.size(), 1u);
  EXPECT_EQ(missed[0].name, "deviation");
  EXPECT_EQ(missed[0].limit, 0.01);
  EXPECT_EQ(missed[0].worst.at(0).value, 0.02);
  EXPECT_EQ(missed[0].worst.at(0).at, change.farthest);
}

}  // namespace
}  // namespace ccdt::bench
