#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/base/portable_math.h"
#include "engine/io/tet_mesh_files.h"
#include "tools/tests/program.h"

// What `ccdt mesh` requires of a finished mesh and of a new surface.

namespace ccdt {
namespace {

using Json = nlohmann::json;

class Requirements : public Program {
 protected:
  Requirements() { EXPECT_EQ(run("model torus --edge-length 0.3 -o part.off").exit_code, 0); }

  /// Meshes the part, and returns the report.
  Json report_of(const std::string& options, int exit_code) const {
    const Outcome outcome = run("mesh part.off -o part.vtu --report r.json " + options);
    EXPECT_EQ(outcome.exit_code, exit_code) << options << "\n" << outcome.err;
    return Json::parse(text_of(work() / "r.json"));
  }

  /// The largest requirement of dihedral angles that the mesh keeps.
  static double least_angle(const Json& report) {
    const Json& angles = report["quality"]["dihedral_degrees"];
    return std::min(angles["min"].get<double>(), 180 - angles["max"].get<double>());
  }

  /// The larger one of two numbers of a report.
  static double larger(const Json& one, const Json& other) { return std::max(one.get<double>(), other.get<double>()); }

  /// A unit sphere of meridians and circles of latitude, as CAD programs draw it: with needles at the poles.
  static std::string sphere_with_poles(int meridians, int circles) {
    std::ostringstream off;
    off.precision(17);
    off << "OFF\n" << meridians * (circles - 1) + 2 << " " << 2 * meridians * (circles - 1) << " 0\n";
    for (int c = 1; c < circles; ++c)
      for (int m = 0; m < meridians; ++m) {
        const double down = portable::pi * c / circles, around = 2 * portable::pi * m / meridians;
        off << std::sin(down) * std::cos(around) << " " << std::sin(down) * std::sin(around) << " " << std::cos(down)
            << "\n";
      }
    off << "0 0 1\n0 0 -1\n";
    const auto at = [&](int c, int m) { return (c - 1) * meridians + m % meridians; };
    const int top = meridians * (circles - 1);
    for (int m = 0; m < meridians; ++m) {
      off << "3 " << top << " " << at(1, m) << " " << at(1, m + 1) << "\n";
      off << "3 " << top + 1 << " " << at(circles - 1, m + 1) << " " << at(circles - 1, m) << "\n";
      for (int c = 1; c + 1 < circles; ++c) {
        off << "3 " << at(c, m) << " " << at(c + 1, m) << " " << at(c + 1, m + 1) << "\n";
        off << "3 " << at(c, m) << " " << at(c + 1, m + 1) << " " << at(c, m + 1) << "\n";
      }
    }
    return off.str();
  }

  /// Is there a tetrahedron around this point?
  bool has_center(const Json& at) const {
    const mesh::TetMesh mesh = io::read_tet_mesh(work() / "part.vtu");
    const Point3 p{at[0], at[1], at[2]};
    for (const auto& t : mesh.tetrahedra) {
      Point3 center;
      for (const std::uint32_t v : t) center = center + 0.25 * mesh.vertices[v];
      if (squared_length(center - p) < 1e-20) return true;
    }
    return false;
  }
};

TEST_F(Requirements, ThatHoldChangeNothing) {
  const Json report = report_of("--require-dihedral 1 --require-r 1000", 0);
  EXPECT_EQ(report["status"], "ok");
  EXPECT_EQ(report["required"], Json({{"dihedral_degrees", 1}, {"r", 1000}}));
  EXPECT_FALSE(report.contains("missed"));
  EXPECT_FALSE(report_of("", 0).contains("required"));
}

TEST_F(Requirements, ThatAreMissedLeaveTheMeshAndSayWhere) {
  const Json report = report_of("--require-dihedral 65 --require-r 1.05", 1);
  EXPECT_EQ(report["status"], "failed");
  EXPECT_EQ(report["kind"], "missed");
  EXPECT_EQ(run("verify part.off part.vtu").exit_code, 0);
  ASSERT_EQ(report["missed"].size(), 2u);
  for (const Json& missed : report["missed"]) {
    EXPECT_GT(missed["count"], 5);
    EXPECT_LE(missed["count"], report["counts"]["tetrahedra"]);
    ASSERT_EQ(missed["worst"].size(), 5u);
    for (const Json& spot : missed["worst"]) EXPECT_TRUE(has_center(spot["at"])) << spot;
  }
  const double worst = report["missed"][0]["worst"][0]["value"];
  EXPECT_NEAR(std::min(worst, 180 - worst), least_angle(report), 1e-9);
  EXPECT_NEAR(report["missed"][1]["worst"][0]["value"], report["quality"]["r"]["max"], 1e-9);
}

TEST_F(Requirements, CountTheTetrahedraThatMissThem) {
  const double angle = least_angle(report_of("", 0));
  report_of("--require-dihedral " + std::to_string(angle - 1e-3), 0);
  EXPECT_GE(report_of("--require-dihedral " + std::to_string(angle + 1e-3), 1)["missed"][0]["count"], 1);
}

TEST_F(Requirements, HoldForOtherMeshers) {
  write("mine.json", R"({"schema": "ccdt.mesher/1", "name": "mine", "what": "a mesher", "licence": "MIT",
    "command": ["/bin/sh", "-c", "exec \"$0\" mesh \"$1\" -o out.vtu", ")" +
                         std::string(CCDT_PROGRAM) + R"(", "{input}"], "input_format": "ply", "output": "out.vtu"})");
  EXPECT_EQ(report_of("--mesher mine.json --require-r 1.05", 1)["missed"][0]["name"], "r");
  report_of("--mesher mine.json --require-r 1000", 0);
}

TEST_F(Requirements, AreRefusedIfNoMeshCanKeepThem) {
  for (const char* wrong : {"--require-dihedral 71", "--require-dihedral -1", "--require-r 0.9", "--deviation 0",
                            "--deviation 0.1", "--deviation 0.1 --surface refine"})
    EXPECT_EQ(run(std::string("mesh part.off -o part.vtu ") + wrong).exit_code, 2) << wrong;
}

TEST_F(Requirements, ANewSurfaceHasItsDistanceFromTheOldOne) {
  const Json report = report_of("--surface remesh --edge-length 0.5", 0), surface = report["surface"];
  const double distance = surface["distance"];
  EXPECT_GT(distance, 1e-3);
  EXPECT_LT(distance, 0.1);
  EXPECT_EQ(distance, larger(surface["distance_to_input"], surface["distance_from_input"]));
  EXPECT_FALSE(report_of("", 0).contains("surface"));
}

TEST_F(Requirements, ANewSurfaceStaysWithinTheDeviation) {
  const std::string remesh = "--surface remesh --edge-length 0.5";
  const double distance = report_of(remesh, 0)["surface"]["distance"];
  for (const double share : {0.5, 0.05, 0.005}) {
    const Json report = report_of(remesh + " --deviation " + std::to_string(share * distance), 0);
    EXPECT_EQ(report["status"], "ok");
    EXPECT_LT(report["surface"]["distance"], share * distance);
  }
}

TEST_F(Requirements, ANearSurfaceWithoutNeedlesIsMadeOfOneWithThem) {
  write("part.off", sphere_with_poles(64, 32));
  const Json refined = report_of("--surface refine", 0), automatic = report_of("--surface auto", 0);
  EXPECT_LT(refined["quality"]["dihedral_degrees"]["min"], 10);
  EXPECT_GT(automatic["quality"]["dihedral_degrees"]["min"], 18);
  EXPECT_LT(automatic["quality"]["r"]["max"], 3);
  const double deviation = 1e-4 * 2 * std::sqrt(3.0);
  EXPECT_LT(automatic["surface"]["distance"], deviation);
  EXPECT_EQ(run("mesh part.off -o part.vtu --surface auto --edge-length 0.3").exit_code, 0);
  EXPECT_EQ(run("verify part.off part.vtu --within " + std::to_string(deviation)).exit_code, 0);
}

TEST_F(Requirements, ChordsOfASphereHaveLessArea) {
  ASSERT_EQ(run("model sphere --edge-length 0.08 -o part.off").exit_code, 0);
  const Json surface = report_of("--surface remesh --edge-length 0.4", 0)["surface"];
  EXPECT_LT(surface["area_change"], -0.01);
  EXPECT_GT(surface["area_change"], -0.6);
  EXPECT_LT(surface["volume_change"], -0.01);
  EXPECT_GT(surface["volume_change"], -0.4);
}

TEST_F(Requirements, TheVolumeOfASurfaceThatIsNotOrientedIsUnknown) {
  const std::string box = "OFF\n8 6 0\n0 0 0\n3 0 0\n0 2 0\n3 2 0\n0 0 1\n3 0 1\n0 2 1\n3 2 1\n";
  write("part.off", box + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n");
  EXPECT_NEAR(report_of("--surface remesh --edge-length 0.3", 0)["surface"]["volume_change"], 0, 1e-9);
  write("part.off", box + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 2 6 4\n4 1 5 7 3\n");
  EXPECT_FALSE(report_of("--surface remesh --edge-length 0.3", 0)["surface"].contains("volume_change"));
}

TEST_F(Requirements, OtherTrianglesOfFlatFacetsDoNotDeviate) {
  write("box.off",
        "OFF\n8 6 0\n0 0 0\n3 0 0\n0 2 0\n3 2 0\n0 0 1\n3 0 1\n0 2 1\n3 2 1\n"
        "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n");
  ASSERT_EQ(
      run("mesh box.off -o box.vtu --surface remesh --edge-length 0.3 --deviation 1e-5 --report r.json").exit_code, 0);
  const Json surface = Json::parse(text_of(work() / "r.json"))["surface"];
  EXPECT_LT(surface["distance"], 4e-6);
  EXPECT_NEAR(surface["area_change"], 0, 1e-6);
}

TEST_F(Requirements, AMeshOfANewSurfaceIsVerifiedAgainstTheOldOne) {
  const double distance = report_of("--surface remesh --edge-length 0.5", 0)["surface"]["distance"];
  const auto verify = [&](double within, const std::string& input) {
    return run("verify " + input + " part.vtu --report v.json --within " + std::to_string(within)).exit_code;
  };
  EXPECT_EQ(verify(1.01 * distance, "part.off"), 0);
  const Json report = Json::parse(text_of(work() / "v.json"));
  EXPECT_NEAR(larger(report["distances"]["to_input"], report["distances"]["from_input"]), distance, 0.04 * distance);
  EXPECT_EQ(verify(0.5 * distance, "part.off"), 1);
  EXPECT_EQ(run("verify part.off part.vtu --within 0").exit_code, 2);
  EXPECT_EQ(run("verify part.off part.vtu --within 1 --surface own").exit_code, 2);
}

}  // namespace
}  // namespace ccdt
