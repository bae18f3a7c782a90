#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/io/plc_files.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

/// Two cubes beside each other that share a wall.
plc::InputPlc two_cubes() {
  plc::InputPlc plc;
  for (const double x : {0.0, 1.0, 2.0})
    for (const auto& [y, z] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(1.0, 1.0), std::pair(0.0, 1.0)})
      plc.vertices.push_back({x, y, z});
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    plc.triangles.push_back({a, b, c});
    plc.triangles.push_back({a, c, d});
  };
  for (const std::uint32_t wall : {0u, 4u, 8u}) add(wall, wall + 1, wall + 2, wall + 3);
  for (const std::uint32_t cube : {0u, 4u})
    for (std::uint32_t i = 0; i < 4; ++i) add(cube + i, cube + (i + 1) % 4, cube + 4 + (i + 1) % 4, cube + 4 + i);
  return plc;
}

TEST_F(Program, PeriodicMeshesAreVerified) {
  io::write_plc(two_cubes(), work() / "cubes.off");
  ASSERT_EQ(
      run("mesh cubes.off -o cubes.vtu --surface refine --edge-length 0.2 --periodic xyz --report r.json").exit_code,
      0);
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(work() / "r.json")).at("options").at("periodic"), "xyz");
  EXPECT_EQ(run("verify cubes.off cubes.vtu --periodic xyz").exit_code, 0);
  ASSERT_EQ(run("mesh cubes.off -o free.vtu --surface refine --edge-length 0.2").exit_code, 0);
  EXPECT_EQ(run("verify cubes.off free.vtu").exit_code, 0);
  EXPECT_EQ(run("verify cubes.off free.vtu --periodic xyz").exit_code, 1);
}

TEST_F(Program, PeriodicSidesMustBeEqual) {
  plc::InputPlc cubes = two_cubes();
  cubes.vertices[9].y = 1.25;
  io::write_plc(cubes, work() / "cubes.off");
  EXPECT_EQ(run("mesh cubes.off -o cubes.vtu --periodic x").exit_code, 3);
  EXPECT_EQ(run("mesh cubes.off -o cubes.vtu").exit_code, 0);
}

TEST_F(Program, PeriodicIsForCcdtAndSurfacesThatStay) {
  io::write_plc(two_cubes(), work() / "cubes.off");
  EXPECT_EQ(run("mesh cubes.off -o cubes.vtu --periodic x --surface auto").exit_code, 2);
  EXPECT_EQ(run("mesh cubes.off -o cubes.vtu --periodic x --mesher tetgen").exit_code, 2);
}

}  // namespace
}  // namespace ccdt
