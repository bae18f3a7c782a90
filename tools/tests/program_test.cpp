#include "tools/tests/program.h"

#include <nlohmann/json.hpp>
#include <set>

#include "engine/base/thread_backend.h"

namespace ccdt {
namespace {

using Json = nlohmann::json;

constexpr const char* cube_off =
    "OFF\n8 12 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n"
    "3 0 2 1\n3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n3 2 6 3\n3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n";

TEST_F(Program, HelpOfEveryVerbHasAnExample) {
  EXPECT_EQ(run("--help").exit_code, 0);
  for (const std::string verb : {"model", "check", "mesh", "verify", "reproduce"}) {
    const Outcome help = run(verb + " --help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.out.find("Example"), std::string::npos) << help.out;
    EXPECT_NE(help.out.find("ccdt " + verb), std::string::npos) << help.out;
  }
}

TEST_F(Program, HelpOfModelListsTheSolids) {
  const std::string help = run("model --help").out;
  for (const char* solid : {"piston", "bracket", "stepping-pole", "cube", "sphere", "torus", "schoenhardt"})
    EXPECT_NE(help.find(solid), std::string::npos) << solid;
}

TEST_F(Program, LoadsNoLibraryFromTheCurrentFolder) {
  write("libz.so.1", "no library");
  EXPECT_EQ(run("--version").exit_code, 0);
}

TEST_F(Program, WrongUsageExitsWithTwoAndWritesNothing) {
  write("cube.off", cube_off);
  for (const char* arguments :
       {"", "frobnicate", "mesh", "mesh cube.off", "mesh cube.off -o", "mesh cube.off -o a.vtu --mesher nobody",
        "mesh cube.off -o a.vtu --lattice hcp", "mesh cube.off -o a.vtu --edge-length 0",
        "mesh cube.off -o a.vtu --edge-length -1", "mesh cube.off -o a.vtu --edge-length nan",
        "mesh cube.off -o a.vtu --edge-length two", "mesh cube.off -o a.vtu --grading -1",
        "mesh cube.off -o a.vtu --unknown", "mesh cube.off another.off -o a.vtu", "model teapot -o a.off",
        "verify cube.off", "reproduce table1", "reproduce table9 -o d", "reproduce -o d --runs 5"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err, "") << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(file_count(), 1u) << arguments;
  }
}

TEST_F(Program, StrategyThatThisBuildLacksIsRefusedWithTheOnesThatThereAre) {
  write("cube.off", cube_off);
  for (const auto& [option, missing, there] :
       std::vector<std::array<std::string, 3>>{{"--locator", "tree", "octree"},
                                               {"--delaunay", "sweep", "insert"},
                                               {"--improve", "sweep", "swap"},
                                               {"--surface", "smooth", "remesh"}}) {
    const Outcome outcome = run("mesh cube.off -o a.vtu " + option + " " + missing);
    EXPECT_EQ(outcome.exit_code, 2) << option;
    EXPECT_NE(outcome.err.find(there), std::string::npos) << outcome.err;
  }
}

TEST_F(Program, RemeshingNeedsAnEdgeLengthAndANewSurfaceNeedsRemeshing) {
  write("cube.off", cube_off);
  const Outcome no_length = run("mesh cube.off -o a.vtu --surface remesh");
  EXPECT_EQ(no_length.exit_code, 2);
  EXPECT_NE(no_length.err.find("--edge-length"), std::string::npos) << no_length.err;
  const Outcome no_surface = run("mesh cube.off -o a.vtu --surface-output b.off");
  EXPECT_EQ(no_surface.exit_code, 2);
  EXPECT_NE(no_surface.err.find("--surface auto"), std::string::npos) << no_surface.err;
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(Program, ANewSurfaceIsWrittenOnlyWhereItsVerticesStayExact) {
  write("cube.off", cube_off);
  const std::string remesh = "mesh cube.off -o a.vtu --surface remesh --edge-length 0.3 --surface-output ";
  for (const std::string file : {"even.stl", "even.STL", "even.xyz", "even"}) {
    EXPECT_EQ(run(remesh + file).exit_code, 3) << file;
    EXPECT_EQ(file_count(), 1u) << file;
  }
  for (const std::string file : {"even.off", "even.obj", "even.ply", "even.poly"}) {
    EXPECT_EQ(run(remesh + file).exit_code, 0) << file;
    EXPECT_EQ(run("verify " + file + " a.vtu").exit_code, 0) << file;
  }
}

TEST_F(Program, OnlyCcdtRefinesASurface) {
  write("cube.off", cube_off);
  EXPECT_EQ(run("mesh cube.off -o a.vtu --surface refine --mesher tetgen").exit_code, 2);
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(Program, AnyNumberOfThreadsIsALimitThatCanBeKept) {
  write("cube.off", cube_off);
  EXPECT_EQ(run("mesh cube.off -o a.vtu --threads 8").exit_code, 0);
  EXPECT_EQ(run("mesh cube.off -o a.vtu --threads 0").exit_code, 2);
  EXPECT_EQ(run("verify cube.off a.vtu --threads 8").exit_code, 0);
  EXPECT_EQ(run("verify cube.off a.vtu --threads 0").exit_code, 2);
}

TEST_F(Program, ASmallFileIsMeshedOnOneThreadUnlessMoreAreAskedForOrItIsFilled) {
  write("cube.off", cube_off);
  const auto threads = [&](const std::string& options) {
    EXPECT_EQ(run("mesh cube.off -o a.vtu --report r.json " + options).exit_code, 0);
    return Json::parse(text_of(work() / "r.json"))["options"]["threads"].get<unsigned>();
  };
  EXPECT_EQ(threads("--lattice none"), 1u);
  EXPECT_EQ(threads("--lattice none --threads 3"), 3u);
  EXPECT_EQ(threads("--edge-length 0.4"), thread_backend::core_count());
}

TEST_F(Program, AnEdgeLengthBeyondThePartIsReplacedAndNoted) {
  write("cube.off", cube_off);
  for (const std::string options : {"", " --surface refine", " --surface remesh"}) {
    const Outcome outcome = run("mesh cube.off -o a.vtu --edge-length 1e300" + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("--edge-length 1e+300 is longer than the whole part"), std::string::npos) << outcome.out;
    EXPECT_EQ(run("mesh cube.off -o b.vtu --edge-length 2" + options).exit_code, 0);  // the diagonal is 1.7
    EXPECT_EQ(text_of(work() / "a.vtu"), text_of(work() / "b.vtu")) << options;
  }
  EXPECT_EQ(run("mesh cube.off -o a.vtu --edge-length 1.7").out.find("longer than"), std::string::npos);
}

TEST_F(Program, AnEdgeLengthThatNeedsTooManyVerticesExitsWithFour) {
  write("cube.off", cube_off);
  const std::size_t before = file_count();
  for (const std::string length : {"1e-300", "0.0000001"})
    for (const std::string options : {"", " --surface refine", " --surface remesh", " --lattice bcc --grading 0"}) {
      const Outcome outcome = run("mesh cube.off -o a.vtu --edge-length " + length + options);
      EXPECT_EQ(outcome.exit_code, 4) << options;
      EXPECT_NE(outcome.err.find("the edge length is too short"), std::string::npos) << outcome.err;
      EXPECT_NE(outcome.err.find("--edge-length"), std::string::npos) << outcome.err;
      EXPECT_EQ(file_count(), before);
    }
}

TEST_F(Program, BadInputExitsWithThreeOneMessageAndNothingWritten) {
  write("empty.off", "");
  write("nonsense.stl", "this is no surface");
  write("nan.off", "OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n");
  write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n");
  std::filesystem::create_directory(work() / "folder.off");
  const std::size_t before = file_count();
  for (const std::string input :
       {"empty.off", "nonsense.stl", "nan.off", "open.off", "folder.off", "missing.off", "a.xyz"}) {
    const Outcome outcome = run("mesh " + input + " -o a.vtu");
    EXPECT_EQ(outcome.exit_code, 3) << input;
    EXPECT_EQ(outcome.err.rfind("ccdt: " + input, 0), 0u) << outcome.err;
    EXPECT_EQ(outcome.err.find("ccdt:", 1), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(file_count(), before) << input;
  }
}

TEST_F(Program, OutputThatCannotBeWrittenIsRefusedBeforeTheWork) {
  write("cube.off", cube_off);
  std::filesystem::create_directory(work() / "folder.vtu");
  for (const std::string output : {"a.xyz", "nowhere/a.vtu", "folder.vtu"}) {
    // The input does not exist either: the output is looked at first.
    const Outcome outcome = run("mesh missing.off -o " + output);
    EXPECT_EQ(outcome.exit_code, 3) << output;
    EXPECT_NE(outcome.err.find(output), std::string::npos) << outcome.err;
  }
  const Outcome report = run("mesh missing.off -o a.vtu --report nowhere/a.json");
  EXPECT_EQ(report.exit_code, 3);
  EXPECT_NE(report.err.find("nowhere/a.json"), std::string::npos) << report.err;
}

TEST_F(Program, NeverOverwritesItsInput) {
  write("cube.off", cube_off);
  ASSERT_EQ(run("mesh cube.off -o cube.mesh").exit_code, 0);
  const std::string before = text_of(work() / "cube.mesh");
  EXPECT_EQ(run("mesh cube.mesh -o ./cube.mesh").exit_code, 3);
  EXPECT_EQ(run("mesh cube.off -o a.vtu --report cube.off").exit_code, 3);
  EXPECT_EQ(text_of(work() / "cube.mesh"), before);
  EXPECT_EQ(text_of(work() / "cube.off"), cube_off);
}

TEST_F(Program, MeshesACubeAndVerifiesIt) {
  write("cube.off", cube_off);
  for (const std::string options :
       {"--lattice none", "--lattice fcc --edge-length 0.3", "--lattice bcc --edge-length 0.3",
        "--lattice sc --edge-length 0.3", "--face-protection off"}) {
    const Outcome mesh = run("mesh cube.off -o cube.vtu " + options);
    EXPECT_EQ(mesh.exit_code, 0) << options << mesh.err;
    EXPECT_NE(mesh.out.find("cube.vtu"), std::string::npos) << mesh.out;
    EXPECT_EQ(mesh.err, "");
    const Outcome verify = run("verify cube.off cube.vtu --report checks.json");
    EXPECT_EQ(verify.exit_code, 0) << options << verify.out << verify.err;
    EXPECT_TRUE(Json::parse(text_of(work() / "checks.json")).at("ok").get<bool>());
  }
}

TEST_F(Program, VerifyExitsWithOneForAMeshOfAnotherPart) {
  write("cube.off", cube_off);
  ASSERT_EQ(run("model cube --edge-length 0.5 -o other.off").exit_code, 0);
  ASSERT_EQ(run("mesh cube.off -o cube.mesh --lattice none").exit_code, 0);
  const Outcome outcome = run("verify other.off cube.mesh");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("input facets"), std::string::npos) << outcome.out;
}

TEST_F(Program, VerifyAcceptsASurfaceOfTheMeshersOwnIfAsked) {
  ASSERT_EQ(run("model sphere --edge-length 0.3 -o sphere.off").exit_code, 0);
  ASSERT_EQ(run("model sphere --edge-length 0.2 -o finer.off").exit_code, 0);
  ASSERT_EQ(run("mesh finer.off -o sphere.mesh").exit_code, 0);
  EXPECT_EQ(run("verify sphere.off sphere.mesh").exit_code, 1);
  const Outcome own = run("verify --surface own sphere.off sphere.mesh --report checks.json");
  EXPECT_EQ(own.exit_code, 0) << own.out;
  const Json checks = Json::parse(text_of(work() / "checks.json"));
  EXPECT_EQ(checks.at("schema"), "ccdt.verify/1");
  EXPECT_TRUE(checks.at("ok").get<bool>());
}

TEST_F(Program, ReportOfARunSaysWhatWasMeshedHowAndHowLong) {
  ASSERT_EQ(run("model cube --edge-length 0.25 -o cube.off").exit_code, 0);
  ASSERT_EQ(run("mesh cube.off -o cube.vtu --edge-length 0.25 --lattice bcc --report r.json").exit_code, 0);
  const Json report = Json::parse(text_of(work() / "r.json"));
  EXPECT_EQ(report["schema"], "ccdt.run/1");
  EXPECT_EQ(report["status"], "ok");
  EXPECT_EQ(report["mesher"]["name"], "ccdt");
  EXPECT_EQ(report["input"]["name"], "cube.off");
  EXPECT_EQ(report["input"]["vertices"], 98);
  EXPECT_EQ(report["input"]["facets"], 192);
  EXPECT_EQ(report["input"]["sha256"].get<std::string>().size(), 64u);
  EXPECT_EQ(report["options"]["lattice"], "bcc");
  EXPECT_EQ(report["options"]["edge_length"], 0.25);
  EXPECT_EQ(report["options"]["face_protection"], true);
  EXPECT_GT(report["counts"]["interior_vertices"], 0);
  EXPECT_GT(report["seconds"]["mesh"], 0);
  EXPECT_GT(report["peak_rss_bytes"], 1 << 20);
  EXPECT_GE(report["quality"]["r"]["min"], 1);
  EXPECT_NEAR(report["volume"].get<double>(), 1, 1e-12);
}

TEST_F(Program, ReportOfARunSaysWhatEachStageDid) {
  ASSERT_EQ(run("model cube --edge-length 0.25 -o cube.off").exit_code, 0);
  ASSERT_EQ(run("mesh cube.off -o cube.vtu --edge-length 0.25 --surface remesh --report r.json").exit_code, 0);
  const Json work = Json::parse(text_of(this->work() / "r.json"))["work"];
  EXPECT_GT(work["delaunay"]["cells_created"], work["delaunay"]["cells_destroyed"]);
  EXPECT_GT(work["delaunay"]["exact_evaluations"], 0);
  EXPECT_TRUE(work.contains("remesh"));
  EXPECT_FALSE(work.contains("front")) << "all faces of a cube are Delaunay";
}

TEST_F(Program, ReportIsWrittenForAFailureToo) {
  write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n");
  EXPECT_EQ(run("mesh open.off -o a.vtu --report r.json").exit_code, 3);
  const Json report = Json::parse(text_of(work() / "r.json"));
  EXPECT_EQ(report["status"], "failed");
  EXPECT_NE(report["reason"], "");
  EXPECT_EQ(report["input"]["name"], "open.off");
  EXPECT_FALSE(std::filesystem::exists(work() / "a.vtu"));
}

TEST_F(Program, EveryMesherOfTheBuildGivesTheSameReport) {
  write("cube.off", cube_off);
  const std::string help = run("mesh --help").out;
  Json ours;
  for (const std::string name : {"ccdt", "tetgen", "cgal-mesh3", "cgal-delaunay"}) {
    if (help.find("  " + name + " ") == std::string::npos) continue;  // built without it
    const Outcome outcome = run("mesh cube.off -o cube.vtu --edge-length 0.4 --report r.json --mesher " + name);
    ASSERT_EQ(outcome.exit_code, 0) << name << outcome.err;
    const Json report = Json::parse(text_of(work() / "r.json"));
    EXPECT_EQ(report["mesher"]["name"], name);
    EXPECT_NEAR(report["volume"].get<double>(), 1, 1e-6) << name;
    if (name == "ccdt") ours = report;
    const std::set<std::string> only_ours = {"work", "cpu_seconds", "threads"};
    for (const auto& [key, value] : ours.items())
      EXPECT_NE(report.contains(key), only_ours.contains(key) && name != "ccdt") << name << " " << key;
  }
}

}  // namespace
}  // namespace ccdt
