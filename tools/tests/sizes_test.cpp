#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "tools/tests/program.h"

// Size functions from files, through the program alone.

namespace ccdt {
namespace {

using namespace mesh_test;

double size_at(const Point3& p) {
  return 0.05 + 0.1 * p.x;
}

class Sizes : public Program {
 protected:
  /// A unit cube with a grid on its faces, and as the background the same cube, coarser.
  Sizes() {
    io::write_plc(gridded_cube(20), work() / "cube.off");
    io::write_plc(gridded_cube(4), work() / "coarse.off");
  }

  /// Writes a mesh of the coarse cube in the format of this name, and the sizes at its vertices.
  void write_background(const std::string& mesh, const std::string& sizes) const {
    ASSERT_EQ(run("mesh coarse.off -o " + mesh + " --lattice none").exit_code, 0);
    const mesh::TetMesh background = io::read_tet_mesh(work() / mesh);
    const std::string count = std::to_string(background.vertices.size());
    const bool medit = sizes.ends_with(".sol");
    std::string text =
        medit ? "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n" + count + "\n1 1\n" : count + " 1\n";
    for (const Point3& p : background.vertices) text += std::to_string(size_at(p)) + "\n";
    write(sizes, text + (medit ? "End\n" : ""));
  }

  /// Interior points have the spacing of the function within a factor of sqrt(2), as their density in ten slabs shows.
  void expect_followed(const std::string& mesh) const {
    const mesh::TetMesh result = io::read_tet_mesh(work() / mesh);
    constexpr int slabs = 10;
    constexpr double low = 0.3, high = 0.7;  // in y and z: away from the surface
    std::array<double, slabs> count{};
    for (const Point3& p : result.vertices)
      if (std::min(p.y, p.z) > low && std::max(p.y, p.z) < high && p.x > 0 && p.x < 1)
        ++count[static_cast<std::size_t>(p.x * slabs)];
    for (int i = 2; i < slabs - 2; ++i) {
      const double volume = std::pow(high - low, 2) / slabs;
      const double spacing = std::cbrt(std::sqrt(2.0) * volume / count[i]);
      const double left = size_at({double(i) / slabs, 0, 0}), right = size_at({(i + 1.0) / slabs, 0, 0});
      EXPECT_GT(spacing, left / std::sqrt(2.0)) << i;
      EXPECT_LT(spacing, right * std::sqrt(2.0)) << i;
    }
  }

  void expect_refused(const std::string& sizes, const std::string& data) const {
    SCOPED_TRACE(sizes);
    const std::size_t before = file_count();
    const Outcome outcome = run("mesh cube.off -o out.vtu --sizes " + sizes);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(data), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("\n  "), std::string::npos) << "no remedy: " << outcome.err;
    EXPECT_EQ(file_count(), before);
  }
};

TEST_F(Sizes, OfMeditAreFollowed) {
  write_background("background.mesh", "background.sol");
  const Outcome outcome = run("mesh cube.off -o out.vtu --sizes background.sol --report report.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_followed("out.vtu");
  EXPECT_EQ(run("verify cube.off out.vtu").exit_code, 0);
  const auto report = nlohmann::json::parse(text_of(work() / "report.json"));
  EXPECT_EQ(report["options"]["sizes"], "background.sol");
}

TEST_F(Sizes, OfTetGenAreFollowedAndSayTheSame) {
  write_background("background.mesh", "background.sol");
  write_background("nodes.node", "nodes.mtr");
  ASSERT_EQ(run("mesh cube.off -o sol.vtu --sizes background.sol").exit_code, 0);
  ASSERT_EQ(run("mesh cube.off -o mtr.vtu --sizes nodes.mtr").exit_code, 0);
  expect_followed("mtr.vtu");
  EXPECT_EQ(text_of(work() / "sol.vtu"), text_of(work() / "mtr.vtu"));
}

TEST_F(Sizes, OfTheVerticesOfTheInputItselfAreTaken) {
  io::write_plc(gridded_cube(10), work() / "part.poly");
  const plc::InputPlc part = io::read_plc(work() / "part.poly");
  std::string text = std::to_string(part.vertices.size()) + " 1\n";
  for (const Point3& p : part.vertices) text += p.x == 0 ? "0.02\n" : "0.2\n";
  write("part.mtr", text);
  ASSERT_EQ(run("mesh part.poly -o out.node --sizes part.mtr --sphere-factor 0").exit_code, 0);
  std::size_t left = 0, right = 0;
  for (const Point3& p : io::read_tet_mesh(work() / "out.node").vertices) ++(p.x < 0.5 ? left : right);
  EXPECT_GT(left, 4 * right);
}

TEST_F(Sizes, AreBoundedByTheEdgeLength) {
  write_background("background.mesh", "background.sol");
  const auto interior = [&](const std::string& options) {
    EXPECT_EQ(run("mesh cube.off -o out.vtu --report report.json " + options).exit_code, 0);
    return nlohmann::json::parse(text_of(work() / "report.json"))["counts"]["interior_vertices"].get<int>();
  };
  const int by_sizes = interior("--sizes background.sol");
  EXPECT_GT(interior("--sizes background.sol --edge-length 0.06"), by_sizes);
  EXPECT_EQ(interior("--sizes background.sol --edge-length 9"), by_sizes);
}

TEST_F(Sizes, ThatAreDamagedAreRefusedWithTheirPlace) {
  write_background("background.mesh", "background.sol");
  const std::string good = text_of(work() / "background.sol");
  write("alone.sol", good);
  expect_refused("alone.sol", ".mesh");
  expect_refused("nothing.sol", "nothing.sol");
  expect_refused("cube.off", ".sol");
  std::filesystem::copy(work() / "background.mesh", work() / "bad.mesh");
  const auto first = good.find("\n1 1\n") + 5;
  const auto with_first = [&](const std::string& size) {
    write("bad.sol", good.substr(0, first) + size + good.substr(good.find('\n', first)));
  };
  with_first("0");
  expect_refused("bad.sol", "bad.sol:6");
  with_first("nan");
  expect_refused("bad.sol", "bad.sol:6");
  with_first("0.1 0.2");  // one too many is one less for another
  expect_refused("bad.sol", "bad.sol:");
  write("bad.sol", "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n1\n1 1\n0.1\nEnd\n");
  expect_refused("bad.sol", "98");
}

TEST_F(Sizes, AndTheirMeshAreNotOverwritten) {
  write_background("background.mesh", "background.sol");
  const std::string before = text_of(work() / "background.mesh");
  EXPECT_EQ(run("mesh cube.off -o background.mesh --sizes background.sol").exit_code, 3);
  EXPECT_EQ(text_of(work() / "background.mesh"), before);
}

TEST_F(Sizes, LeaveTheirNameInTheReportOfAFailure) {
  expect_refused("missing.sol", "missing.sol");
  EXPECT_EQ(run("mesh cube.off -o out.vtu --sizes missing.sol --report report.json").exit_code, 3);
  const auto report = nlohmann::json::parse(text_of(work() / "report.json"));
  EXPECT_EQ(report["status"], "failed");
  EXPECT_EQ(report["options"]["sizes"], "missing.sol");
  EXPECT_EQ(report["input"]["name"], "cube.off");
}

TEST_F(Sizes, DistancesToTheSurfaceAreOptionsThatTheReportKnows) {
  const auto interior = [&](const std::string& options) {
    EXPECT_EQ(run("mesh cube.off -o out.vtu --edge-length 0.03 --report report.json " + options).exit_code, 0);
    return nlohmann::json::parse(text_of(work() / "report.json"))["counts"]["interior_vertices"].get<int>();
  };
  const int usual = interior("");
  EXPECT_EQ(interior("--sphere-factor 1 --clearance 0.55"), usual);
  EXPECT_LT(interior("--sphere-factor 2"), usual);
  EXPECT_GT(interior("--sphere-factor 0"), usual);
  EXPECT_LT(interior("--clearance 3"), usual);
  const auto options = nlohmann::json::parse(text_of(work() / "report.json"))["options"];
  EXPECT_EQ(options["clearance"], 3);
  EXPECT_EQ(options["sphere_factor"], 1);
  for (const char* wrong : {"--clearance -1", "--sphere-factor nan", "--clearance near"})
    EXPECT_EQ(run(std::string("mesh cube.off -o out.vtu ") + wrong).exit_code, 2);
}

}  // namespace
}  // namespace ccdt
