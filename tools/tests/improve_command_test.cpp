#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/run/quality.h"
#include "engine/geometry/tetrahedron_shape.h"
#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "tools/tests/program.h"

// Improvement through the options of the program.

namespace ccdt {
namespace {

using Json = nlohmann::json;
using namespace mesh_test;

class ImproveCommand : public Program {
 protected:
  /// Meshes with a report, and expects that the independent check finds the mesh right.
  /// \return the report
  Json mesh(const std::string& file, const std::string& options, const std::string& verify_options = "") {
    SCOPED_TRACE(file + " " + options);
    const Outcome made = run("mesh " + file + " -o mesh.vtu --report report.json " + options);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_EQ(made.err, "");
    const Outcome verified = run("verify " + file + " mesh.vtu --report checks.json " + verify_options);
    EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
    return Json::parse(text_of(work() / "report.json"));
  }

  /// Has `ccdt verify` checked a property that the mesh must have?
  bool is_required(const std::string& property) const {
    const Json checks = Json::parse(text_of(work() / "checks.json"));
    for (const Json& check : checks.at("checks"))
      if (check.at("name") == property) return check.at("required");
    ADD_FAILURE() << property << " was not checked";
    return false;
  }

  mesh::TetMesh written() const { return io::read_tet_mesh(work() / "mesh.vtu"); }
};

TEST_F(ImproveCommand, ImprovesByEveryMeansAndReportsIt) {
  io::write_plc(gridded_cube(4), work() / "cube.off");
  const double worst = mesh("cube.off", "--improve none")["quality"]["r"]["max"];
  for (const std::string improve : {"swap", "smooth", "all"})
    for (const std::string objective : {"r", "dihedral"}) {
      const Json report = mesh("cube.off", "--improve " + improve + " --objective " + objective +
                                               " --target-dihedral 35 --target-r 1.25 --improve-time 60");
      EXPECT_EQ(report["options"]["improve"], improve);
      EXPECT_EQ(report["options"]["objective"], objective);
      EXPECT_EQ(report["options"]["boundary"], "keep");
      EXPECT_EQ(report["options"]["target_dihedral"], 35);
      EXPECT_EQ(report["options"]["target_r"], 1.25);
      EXPECT_EQ(report["options"]["improve_time"], 60);
      const Json& counts = report["counts"]["improve"];
      EXPECT_GT(counts["bad_cells"], 0);
      EXPECT_EQ(counts["stop"], counts["bad_cells_left"] == 0 ? "target" : "stuck");
      EXPECT_GT(report["seconds"]["improve"], 0);
      EXPECT_LT(report["seconds"]["improve"], report["seconds"]["mesh"]);
      if (objective == "r") {
        EXPECT_LE(report["quality"]["r"]["max"], worst);
      }
      EXPECT_EQ(counts["moved_vertices"] == 0, improve == "swap");
      EXPECT_EQ(counts["removed_edges"] == 0 && counts["removed_faces"] == 0, improve == "smooth");
    }
}

TEST_F(ImproveCommand, ImprovesByAllMeansWithTheBoundaryKeptUnlessToldOtherwise) {
  io::write_plc(gridded_cube(4), work() / "cube.off");
  const Json usual = mesh("cube.off", "");
  EXPECT_EQ(usual["options"]["improve"], "all");
  EXPECT_EQ(usual["options"]["objective"], "r");
  EXPECT_EQ(usual["options"]["boundary"], "keep");
  const Json none = mesh("cube.off", "--improve none");
  EXPECT_EQ(none["options"]["improve"], "none");
  EXPECT_EQ(none["counts"]["improve"]["stop"], "none");
  EXPECT_EQ(none["seconds"]["improve"], 0);
}

TEST_F(ImproveCommand, BoundaryVerticesSlideWhereTheyMay) {
  for (const plc::InputPlc& plc : {gridded_plate(4, 0.1), rotated(oblique, gridded_cube(3))}) {
    io::write_plc(plc, work() / "part.off");
    const Json report = mesh("part.off", "--boundary slide --target-dihedral 45", "--boundary slide");
    EXPECT_EQ(report["options"]["boundary"], "slide");
  }
}

TEST_F(ImproveCommand, RegionsSlitsAndDanglingPartsStay) {
  for (const auto& [name, plc] : small_inputs()) {
    SCOPED_TRACE(name);
    io::write_plc(plc, work() / "part.poly");
    mesh("part.poly", "--edge-length 0.8 --target-dihedral 45");
  }
}

TEST_F(ImproveCommand, WithoutALatticeTheMeshStaysConstrainedDelaunayUnlessImprovementIsAskedFor) {
  io::write_plc(rotated(oblique, l_shape()), work() / "part.off");
  const Json bare = mesh("part.off", "--lattice none", "--constrained-delaunay yes");
  EXPECT_EQ(bare["options"]["improve"], "none");
  EXPECT_EQ(bare["counts"]["improve"]["stop"], "none");
  EXPECT_TRUE(is_required("locally Delaunay faces"));
  const Json asked = mesh("part.off", "--lattice none --improve swap --target-dihedral 60");
  EXPECT_EQ(asked["options"]["improve"], "swap");
  EXPECT_NE(asked["counts"]["improve"]["stop"], "none");
}

TEST_F(ImproveCommand, SteinerVerticesAreRemovedUnlessToldOtherwise) {
  io::write_plc(plc_test::schoenhardt(), work() / "part.off");
  const Json removed = mesh("part.off", "--lattice none");
  EXPECT_EQ(removed["options"]["steiner"], "remove");
  EXPECT_GT(removed["counts"]["improve"]["removed_steiner_vertices"], 0);
  EXPECT_FALSE(is_required("locally Delaunay faces, not claimed"));
  const Json kept = mesh("part.off", "--lattice none --steiner keep", "--constrained-delaunay yes");
  EXPECT_EQ(kept["options"]["steiner"], "keep");
  EXPECT_TRUE(is_required("locally Delaunay faces"));
  const std::uint64_t left = removed["counts"]["steiner_vertices"], all = kept["counts"]["steiner_vertices"];
  EXPECT_GT(left, 0u);
  EXPECT_EQ(left + removed["counts"]["improve"]["removed_steiner_vertices"].get<std::uint64_t>(), all);
}

TEST_F(ImproveCommand, SaysWhyItStopped) {
  io::write_plc(gridded_cube(6), work() / "cube.off");
  const auto stop = [&](const std::string& options) { return mesh("cube.off", options)["counts"]["improve"]["stop"]; };
  EXPECT_EQ(stop("--target-dihedral 1 --target-r 1000"), "target");
  EXPECT_EQ(stop("--target-dihedral 60"), "stuck");
  EXPECT_EQ(stop("--target-dihedral 60 --improve-time 1e-9"), "time");
}

TEST_F(ImproveCommand, ImprovedMeshDoesNotClaimToBeDelaunay) {
  io::write_plc(gridded_cube(4), work() / "cube.off");
  mesh("cube.off", "--improve none");
  EXPECT_TRUE(is_required("locally Delaunay faces"));
  const Json report = mesh("cube.off", "--target-dihedral 45");
  EXPECT_GT(report["counts"]["improve"]["moved_vertices"], 0);
  EXPECT_FALSE(is_required("locally Delaunay faces, not claimed"));
}

TEST_F(ImproveCommand, WritesTheSameMeshAgain) {
  io::write_plc(rotated(oblique, gridded_cube(4)), work() / "cube.off");
  mesh("cube.off", "--target-dihedral 40");
  const mesh::TetMesh first = written();
  mesh("cube.off", "--target-dihedral 40 --delaunay wrap --locator grid");
  EXPECT_TRUE(first.vertices == written().vertices);
  EXPECT_TRUE(first.tetrahedra == written().tetrahedra);
}

TEST_F(ImproveCommand, WrongValuesAreWrongUsage) {
  io::write_plc(unit_cube(), work() / "cube.off");
  for (const std::string options :
       {"--improve", "--improve flip", "--improve 1", "--objective volume", "--objective", "--boundary move",
        "--boundary", "--target-dihedral 61", "--target-dihedral -1", "--target-dihedral nan", "--target-dihedral all",
        "--target-r 0.9", "--target-r nan", "--improve-time -1", "--improve-time nan", "--improve-time soon"}) {
    const Outcome outcome = run("mesh cube.off -o mesh.vtu " + options);
    EXPECT_EQ(outcome.exit_code, 2) << options;
    EXPECT_NE(outcome.err, "") << options;
    EXPECT_EQ(outcome.out, "") << options;
    EXPECT_EQ(file_count(), 1u) << options;
  }
  EXPECT_EQ(run("verify cube.off cube.off --boundary move").exit_code, 2);
}

TEST_F(Program, ImproveMakesTheMeshOfAnotherMesherBetterAndKeepsItRight) {
  ASSERT_EQ(run("model piston --edge-length 6 -o part.poly").exit_code, 0);
  const auto worst_of = [&](const std::string& name) {
    double worst = 0;
    const mesh::TetMesh read = io::read_tet_mesh(work() / name);
    for (const auto& [a, b, c, d] : read.tetrahedra)
      worst = std::max(
          worst, shape_measure(std::array{read.vertices[a], read.vertices[b], read.vertices[c], read.vertices[d]}));
    return worst;
  };
  for (const char* mesher : {"tetgen", "cgal-mesh3"})
    for (const char* ending : {"mesh", "vtu", "msh", "node"}) {
      SCOPED_TRACE(std::string(mesher) + " " + ending);
      const std::string mesh = std::string("theirs.") + ending, better = std::string("better.") + ending;
      ASSERT_EQ(run("mesh part.poly -o " + mesh + " --edge-length 6 --mesher " + mesher).exit_code, 0);
      const Outcome outcome = run("improve " + mesh + " -o " + better);
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_LT(worst_of(better), 0.8 * worst_of(mesh));
      const std::string own = mesher == std::string("tetgen") ? "" : " --surface own";
      EXPECT_EQ(run("verify part.poly " + better + own).exit_code, 0);
    }
}

TEST_F(Program, ImproveRefusesWhatIsNoMesh) {
  ASSERT_EQ(run("model cube --edge-length 1 -o part.poly").exit_code, 0);
  ASSERT_EQ(run("mesh part.poly -o part.mesh").exit_code, 0);
  EXPECT_EQ(run("improve none.mesh -o better.mesh").exit_code, 3);
  EXPECT_EQ(run("improve part.poly -o better.mesh").exit_code, 3);
  EXPECT_EQ(run("improve part.mesh -o part.mesh").exit_code, 3);
  EXPECT_EQ(run("improve part.mesh -o better.xyz").exit_code, 3);
  EXPECT_EQ(run("improve part.mesh").exit_code, 2);
  write("flat.mesh",
        "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n1 1 0 0\n"
        "Tetrahedra 1\n1 2 3 4 0\nEnd\n");
  EXPECT_EQ(run("improve flat.mesh -o better.mesh").exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(work() / "better.mesh"));
}

}  // namespace
}  // namespace ccdt
