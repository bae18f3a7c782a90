#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tools/tests/program.h"

namespace ccdt {
namespace {

using Json = nlohmann::json;

/// A user's mesher: here our program itself, because it always exists.
class DescribedMesher : public Program {
 protected:
  DescribedMesher() {
    EXPECT_EQ(run("model torus --edge-length 0.4 -o part.off").exit_code, 0);
    describe_ccdt("ply");
  }

  void describe(const std::string& command, const std::string& input_format = "ply") const {
    write("mine.json", R"({"schema": "ccdt.mesher/1", "name": "mine", "what": "a mesher", "licence": "MIT",
      "command": )" + command +
                           R"(, "input_format": ")" + input_format + R"(", "output": "out.vtu",
      "version_command": ["echo", "version 7"], "version_pattern": "[0-9]+"})");
  }

  /// Our program, given the input in this format.
  void describe_ccdt(const std::string& input_format) const {
    describe(
        R"(["/bin/sh", "-c", "exec \"$0\" mesh \"$1\" -o out.vtu", ")" + std::string(CCDT_PROGRAM) + R"(", "{input}"])",
        input_format);
  }

  /// A tetrahedron whose four facets have the markers from 5 on.
  void write_marked_part(const std::string& name, int last_marker = 8) const {
    write(name,
          "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n4 1\n1 0 5\n3 1 3 2\n1 0 6\n3 1 2 4\n1 0 7\n3 2 3 4\n1 0 " +
              std::to_string(last_marker) + "\n3 1 4 3\n0\n0\n");
  }

  /// What `ccdt verify` says of the markers of faces.
  Json check_of_markers(const std::string& input, const std::string& mesh) const {
    run("verify " + input + " " + mesh + " --report v.json");
    const Json verification = Json::parse(text_of(work() / "v.json"));
    for (const Json& check : verification["checks"])
      if (check["name"] == "face markers") return check;
    return {};
  }

  Json report() const { return Json::parse(text_of(work() / "r.json")); }

  /// Meshes with a mesher that one of the project's descriptions describes, and verifies the mesh.
  void expect_right(const std::string& description, const std::string& options) const {
    const std::string file = std::string(DESCRIBED_FOLDER) + "/" + description + ".json";
    const Outcome meshed = run("mesh part.off -o part.vtu --report r.json --mesher '" + file + "' " + options);
    ASSERT_EQ(meshed.exit_code, 0) << meshed.err;
    EXPECT_EQ(report()["mesher"]["name"], description);
    EXPECT_NE(report()["mesher"]["version"], "unknown");
    const Outcome verified = run("verify part.off part.vtu");
    EXPECT_EQ(verified.exit_code, 0) << verified.out;
  }
};

bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null").c_str()) == 0;
}

TEST_F(DescribedMesher, MeshesWithTheReportThatAnyMesherHas) {
  const Outcome meshed = run("mesh part.off -o part.vtu --mesher mine.json --report r.json");
  ASSERT_EQ(meshed.exit_code, 0) << meshed.err;
  EXPECT_EQ(run("verify part.off part.vtu").exit_code, 0);
  EXPECT_EQ(report()["mesher"]["name"], "mine");
  EXPECT_EQ(report()["mesher"]["version"], "7");
  EXPECT_EQ(report()["status"], "ok");
  EXPECT_NE(report()["options"]["mesher_settings"]["command"].get<std::string>().find("input.ply"), std::string::npos);
  EXPECT_GT(report()["counts"]["interior_vertices"], 0);
  EXPECT_GT(report()["seconds"]["mesh"], 0);
}

TEST_F(DescribedMesher, ThatFailsLeavesAReportOfHowItWasAsked) {
  describe(R"(["/bin/sh", "-c", "echo 'out of luck'; exit 5"])");
  const Outcome meshed = run("mesh part.off -o part.vtu --mesher mine.json --report r.json");
  EXPECT_EQ(meshed.exit_code, 1);
  for (const char* data : {"mine", "code 5", "out of luck"})
    EXPECT_NE(meshed.err.find(data), std::string::npos) << meshed.err;
  EXPECT_EQ(report()["status"], "failed");
  EXPECT_EQ(report()["kind"], "refused");
  EXPECT_EQ(report()["mesher"]["version"], "7");
  EXPECT_NE(report()["options"]["mesher_settings"]["command"].get<std::string>().find("exit 5"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(work() / "part.vtu"));
}

TEST_F(DescribedMesher, ThatEndsTheProcessLeavesAReportOfHowItWasAsked) {
  // The parent of a mesher's program is its supervisor.
  describe(R"(["/bin/sh", "-c", "read -r pid name state ccdt rest </proc/$PPID/stat; kill -KILL $ccdt"])");
  EXPECT_NE(run("mesh part.off -o part.vtu --mesher mine.json --report r.json").exit_code, 0);
  EXPECT_EQ(report()["status"], "crashed");
  EXPECT_EQ(report()["kind"], "crashed");
  EXPECT_EQ(report()["mesher"]["name"], "mine");
  EXPECT_EQ(report()["input"]["sha256"].get<std::string>().size(), 64u);
  EXPECT_NE(report()["options"]["mesher_settings"]["command"].get<std::string>().find("kill"), std::string::npos);
}

TEST_F(DescribedMesher, IsRefusedWithFileAndPlaceIfItIsWrong) {
  describe(R"(["mesher", "{inptu}"])");
  const Outcome wrong = run("mesh part.off -o part.vtu --mesher mine.json");
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_TRUE(wrong.err.starts_with("ccdt: mine.json: /command/1: there is no placeholder {inptu}")) << wrong.err;
  const Outcome missing = run("mesh part.off -o part.vtu --mesher nowhere.json");
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_TRUE(missing.err.starts_with("ccdt: nowhere.json: no such file")) << missing.err;
}

TEST_F(DescribedMesher, IsNotComparedByMarkersThatItsInputCouldNotHave) {
  write_marked_part("marked.poly");
  for (const char* format : {"stl", "off"}) {
    describe_ccdt(format);
    for (const char* mesh : {"a.vtu", "a.mesh", "a.meshb", "a.msh", "a.msh4", "a.node"}) {
      ASSERT_EQ(run("mesh marked.poly --mesher mine.json -o " + std::string(mesh)).exit_code, 0);
      EXPECT_EQ(run("verify marked.poly " + std::string(mesh)).exit_code, 0) << format << " " << mesh;
      EXPECT_TRUE(check_of_markers("marked.poly", mesh).contains("not_compared")) << format << " " << mesh;
    }
  }
}

TEST_F(DescribedMesher, IsComparedByMarkersThatItsInputHas) {
  write_marked_part("marked.poly");
  write_marked_part("other.poly", 9);
  for (const char* format : {"ply", "poly", "mesh"}) {
    describe_ccdt(format);
    ASSERT_EQ(run("mesh marked.poly --mesher mine.json -o a.vtu").exit_code, 0);
    EXPECT_EQ(run("verify marked.poly a.vtu").exit_code, 0) << format;
    const Json check = check_of_markers("marked.poly", "a.vtu");
    EXPECT_FALSE(check.contains("not_compared")) << format;
    EXPECT_GE(check["checked"], 4) << format;
    EXPECT_EQ(run("verify other.poly a.vtu").exit_code, 1) << format;
  }
}

TEST_F(DescribedMesher, KeepsItsOwnMarkersIfTheInputHasNone) {
  write("marking.sh", "'" + std::string(CCDT_PROGRAM) +
                          "' mesh \"$1\" -o out.mesh && sed -i '/^Triangles/,/^Tetrahedra/ s/ [0-9]*$/ 3/' out.mesh");
  write("mine.json", R"({"schema": "ccdt.mesher/1", "name": "mine", "what": "a mesher", "licence": "MIT",
    "command": ["sh", "{here}/marking.sh", "{input}"], "input_format": "stl", "output": "out.mesh"})");
  write("plain.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  ASSERT_EQ(run("mesh plain.off --mesher mine.json -o a.mesh").exit_code, 0);
  EXPECT_NE(text_of(work() / "a.mesh").find(" 3\n"), std::string::npos) << text_of(work() / "a.mesh");
  EXPECT_EQ(run("verify plain.off a.mesh").exit_code, 0);
}

TEST_F(DescribedMesher, OfTetgenIsVerified) {
  if (!is_installed("tetgen")) GTEST_SKIP() << "the program tetgen is not installed";
  expect_right("tetgen-program", "");
  expect_right("tetgen-program", "--edge-length 0.3");
  expect_right("tetgen-program", "--lattice none");
}

TEST_F(DescribedMesher, OfGmshIsVerified) {
  if (!is_installed("gmsh")) GTEST_SKIP() << "the program gmsh is not installed";
  write_marked_part("marked.poly");
  const std::string file = std::string(DESCRIBED_FOLDER) + "/gmsh-delaunay.json";
  ASSERT_EQ(run("mesh marked.poly -o marked.vtu --edge-length 0.4 --mesher '" + file + "'").exit_code, 0);
  EXPECT_EQ(run("verify marked.poly marked.vtu").exit_code, 0);
  EXPECT_TRUE(check_of_markers("marked.poly", "marked.vtu").contains("not_compared"));
  expect_right("gmsh-delaunay", "");
  expect_right("gmsh-delaunay", "--edge-length 0.3 --improve none");
}

}  // namespace
}  // namespace ccdt
