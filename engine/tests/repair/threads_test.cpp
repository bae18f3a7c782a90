#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/repair/find_faults.h"
#include "engine/repair/repair_input.h"
#include "engine/tests/repair/repair_cases.h"
#include "models/solids.h"

namespace ccdt {
namespace {

using namespace plc_test;

/// Two spheres through each other. One has holes and separate, shaken triangles.
plc::InputPlc broken_spheres() {
  plc::InputPlc input = models::make_solid("sphere", 0.06);
  input.triangle_markers.clear();
  plc::InputPlc other = rotated(arbitrary, input);
  for (Point3& p : other.vertices) p = p + Point3{0.3, 0.2, 0.1};
  std::mt19937_64 random(4);
  std::erase_if(input.triangles, [&](const auto&) { return random() % 40 == 0; });
  separate_triangles(input);
  std::uniform_real_distribution<double> step(-1e-6, 1e-6);
  for (Point3& p : input.vertices) p = p + Point3{step(random), step(random), step(random)};
  append(input, other);
  return input;
}

TEST(Threads, CheckAndRepairTheSameWay) {
  const plc::InputPlc input = broken_spheres();
  const auto run = [&](unsigned threads) {
    return with_threads(threads, [&] {
      const repair::Repaired repaired = repair::repair_input(input, {.limit = 1});
      return std::pair{repaired.input, repair::find_faults(repaired.input).volume};
    });
  };
  const auto [alone, volume] = run(1);
  EXPECT_GT(volume, 0);
  for (const unsigned threads : {2u, 3u}) {
    const auto [together, other_volume] = run(threads);
    EXPECT_EQ(together.vertices, alone.vertices);
    EXPECT_EQ(together.triangles, alone.triangles);
    EXPECT_EQ(other_volume, volume);
  }
}

}  // namespace
}  // namespace ccdt
