#include "engine/steps/reach_count.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/errors.h"
#include "engine/mesher.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"

namespace ccdt {
namespace {

/// The number that is reached if a factor gives `count_at(factor)`.
template <class CountAt>
double reached(double wanted, const CountAt& count_at) {
  return steps::reach_count(
      wanted, count_at, [](double count) { return count; }, "");
}

TEST(ReachCount, FindsTheFactorOfAnyPower) {
  for (const double power : {-3.0, -2.0, -1.0})
    for (const double wanted : {50.0, 1000.0, 123456.0}) {
      const auto count_at = [&](double factor) { return 1000 * std::pow(factor, power); };
      EXPECT_NEAR(reached(wanted, count_at) / wanted, 1, 0.05);
    }
}

TEST(ReachCount, FindsAFactorBesideAJump) {
  for (const double jump : {0.3, 0.7, 1.4})
    for (const double wanted : {0.8, 0.9, 2.2, 3.0}) {
      const auto count_at = [&](double factor) { return 1e4 * std::pow(factor / jump, -3) * (factor < jump ? 2 : 1); };
      EXPECT_NEAR(reached(1e4 * wanted, count_at) / (1e4 * wanted), 1, 0.05);
    }
}

TEST(ReachCount, GivesUpWithinAJumpAndBelowABound) {
  int calls = 0;
  const auto jumping = [&](double factor) { return ++calls, factor < 0.7 ? 200.0 : 100.0; };
  EXPECT_THROW(reached(150, jumping), LimitError);
  EXPECT_LT(calls, 20);
  const auto bounded = [&](double factor) { return 1000 + 1000 * std::pow(factor, -3); };
  EXPECT_THROW(reached(900, bounded), LimitError);
}

TEST(ReachCount, MakesMeshesOfTheWantedNumber) {
  for (const SurfaceRule rule : {SurfaceRule::keep, SurfaceRule::refine, SurfaceRule::remesh})
    for (const double wanted : {4000.0, 30000.0}) {
      SCOPED_TRACE(std::string(name_of(rule)) + " " + std::to_string(wanted));
      MeshOptions options{.surface = rule, .edge_length = rule == SurfaceRule::remesh ? 0.3 : 0};
      options.local.sizes = {{.edge_length = 0.2, .balls = {{{0, 0, 0}, 0}}}};
      options.tetrahedra = wanted;
      const InputPlc input = plc_test::rotated(mesh_test::oblique, plc_test::gridded_cube(4));
      const MeshResult result = mesh_plc(input, options);
      EXPECT_NEAR(static_cast<double>(result.mesh.tetrahedra.size()) / wanted, 1, 0.05);
      if (rule != SurfaceRule::remesh) mesh_test::expect_right(input, result.mesh);
    }
}

TEST(MostTetrahedra, AreRefusedBeforeTheyAreMade) {
  for (const SurfaceRule rule : {SurfaceRule::keep, SurfaceRule::refine, SurfaceRule::remesh}) {
    SCOPED_TRACE(name_of(rule));
    MeshOptions options{.surface = rule, .edge_length = 0.05};
    const double count = static_cast<double>(mesh_plc(plc_test::gridded_cube(4), options).mesh.tetrahedra.size());
    options.most_tetrahedra = count;
    EXPECT_EQ(static_cast<double>(mesh_plc(plc_test::gridded_cube(4), options).mesh.tetrahedra.size()), count);
    options.most_tetrahedra = count - 1;
    EXPECT_THROW(mesh_plc(plc_test::gridded_cube(4), options), LimitError);
    options.most_tetrahedra = count / 2;
    std::uint64_t done = 0;
    EXPECT_THROW(mesh_plc(plc_test::gridded_cube(4), options,
                          [&](std::string_view stage, std::uint64_t, std::uint64_t) { done += stage == "improve"; }),
                 LimitError);
    EXPECT_EQ(done, 0u) << "the mesh was made all the same";
  }
}

}  // namespace
}  // namespace ccdt
