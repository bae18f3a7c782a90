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
    describe(R"(["/bin/sh", "-c", "exec \"$0\" mesh \"$1\" -o out.vtu", ")" + std::string(CCDT_PROGRAM) +
             R"(", "{input}"])");
  }

  void describe(const std::string& command) const {
    write("mine.json", R"({"schema": "ccdt.mesher/1", "name": "mine", "what": "a mesher", "licence": "MIT",
      "command": )" + command +
                           R"(, "input_format": "ply", "output": "out.vtu",
      "version_command": ["echo", "version 7"], "version_pattern": "[0-9]+"})");
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

TEST_F(DescribedMesher, OfTetgenIsVerified) {
  if (!is_installed("tetgen")) GTEST_SKIP() << "the program tetgen is not installed";
  expect_right("tetgen-program", "");
  expect_right("tetgen-program", "--edge-length 0.3");
  expect_right("tetgen-program", "--lattice none");
}

TEST_F(DescribedMesher, OfGmshIsVerified) {
  if (!is_installed("gmsh")) GTEST_SKIP() << "the program gmsh is not installed";
  expect_right("gmsh-delaunay", "");
  expect_right("gmsh-delaunay", "--edge-length 0.3 --improve none");
}

}  // namespace
}  // namespace ccdt
