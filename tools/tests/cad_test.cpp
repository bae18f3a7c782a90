#include <cstdlib>
#include <nlohmann/json.hpp>

#include "baselines/external_program.h"
#include "baselines/process.h"
#include "engine/io/files.h"
#include "engine/io/tet_mesh_files.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

/// A plate of 40 x 20 x 4 with a round hole, as a STEP file.
bool write_plate(const std::filesystem::path& folder) {
  const auto gmsh = baselines::find_on_path("gmsh");
  if (!gmsh) return false;
  io::OutputFile geometry(folder / "plate.geo");
  geometry << "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 40, 20, 4}; Cylinder(2) = {20, 10, -1, 0, 0, 6, 5};\n"
              "BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };\n";
  geometry.commit();
  return baselines::run_program({gmsh->string(), "plate.geo", "-0", "-o", "plate.step"}, {.folder = folder}).status ==
         baselines::RunStatus::ok;
}

TEST_F(Program, CadFilesAreReadByGmsh) {
  if (!write_plate(work())) GTEST_SKIP() << "there is no Gmsh";
  const Outcome outcome = run("mesh plate.step -o plate.vtu --surface auto --json");
  ASSERT_EQ(outcome.exit_code, 0);
  const mesh::TetMesh mesh = io::read_tet_mesh(work() / "plate.vtu");
  EXPECT_EQ(mesh.face_names.size(), 7u) << "one for each surface of the part";
  double volume = 0;
  for (const auto& [a, b, c, d] : mesh.tetrahedra) {
    const Point3& p = mesh.vertices[a];
    volume += dot(cross(mesh.vertices[b] - p, mesh.vertices[c] - p), mesh.vertices[d] - p) / 6;
  }
  EXPECT_NEAR(volume, 4 * (40 * 20 - M_PI * 25), 4);
  EXPECT_EQ(run("check plate.step").exit_code, 0);
  setenv("GMSH", "/nowhere", 1);
  EXPECT_EQ(run("check plate.step").exit_code, 3);
  unsetenv("GMSH");
  EXPECT_EQ(run("verify plate.step plate.vtu --within 0.01").exit_code, 0);
}

TEST_F(Program, DamagedCadFilesAreRefused) {
  if (!baselines::find_on_path("gmsh")) GTEST_SKIP() << "there is no Gmsh";
  io::OutputFile file(work() / "part.step");
  file << "ISO-10303-21;\nno step file\n";
  file.commit();
  EXPECT_EQ(run("mesh part.step -o part.vtu").exit_code, 3);
  EXPECT_EQ(run("mesh missing.step -o part.vtu").exit_code, 3);
}

TEST_F(Program, FilesBesideCadFilesRunNothing) {
  if (!write_plate(work())) GTEST_SKIP() << "there is no Gmsh";
  for (const char* name : {"plate.step.opt", "plate.opt"}) {
    io::OutputFile options(work() / name);
    options << "SystemCall \"touch '" << (work() / "touched").string() << "'\";\n";
    options.commit();
  }
  EXPECT_EQ(run("check plate.step").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(work() / "touched"));
}

}  // namespace
}  // namespace ccdt
