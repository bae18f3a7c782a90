#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>

#include "baselines/external_program.h"
#include "baselines/process.h"
#include "bench/gate/callgrind_profile.h"
#include "bench/gate/instructions.h"
#include "engine/base/errors.h"

namespace ccdt::gate {
namespace {

/// A profile as callgrind writes it. Each name is defined at its first use, which may be in a caller. Two versions of
/// one stage are called through a lambda, and the stage is called once more from outside the mesher.
constexpr const char* profile = R"(# callgrind format
version: 1
creator: callgrind-3.19.0
positions: line
events: Ir
summary: 2000

ob=(1) /usr/bin/ccdt
fl=(1) ???
fn=(1) main
0 50
cfn=(2) ccdt::mesh_plc(ccdt::plc::InputPlc const&, std::function<void (int)> const&)
calls=1 0
0 1000
cfn=(3) ccdt::surface::remesh_surface(ccdt::plc::InputPlc const&)
calls=1 0
0 500

fn=(3)
0 100
cfn=(4) ccdt::plc::check_plc(ccdt::plc::InputPlc const&)
calls=1 0
0 400

fn=(2)
0 20
cfn=(4)
calls=1 0
0 300
cfn=(5) ccdt::mesh_plc(ccdt::plc::InputPlc const&, std::function<void (int)> const&)::{lambda()#1}::operator()() const
calls=2 0
0 680

fn=(5)
cfn=(6) ccdt::delaunay::build_delaunay(std::span<ccdt::Point3>) [clone .avx2]
calls=1 0
0 600
cfn=(6)
calls=1 +3
0 50
cfn=(7) ccdt::improve::improve_mesh(int)
calls=1 -3
0 30

fn=(6)
0 500
cfn=(8) ccdt::delaunay::build_delaunay(std::span<ccdt::Point3>) [clone .avx2]'2
calls=1 0
0 150

fn=(8)
0 150

totals: 2000
)";

TEST(StageInstructionsTest, StagesGetTheCostOfTheirCallsFromTheMesher) {
  const StageInstructions stages = stage_instructions(profile);
  EXPECT_EQ(stages.at("mesh"), 1000);
  EXPECT_EQ(stages.at("plc"), 300);       // not that of the new surface
  EXPECT_EQ(stages.at("delaunay"), 650);  // without counting the call of itself again
  EXPECT_EQ(stages.at("improve"), 30);
  EXPECT_EQ(stages.at("remesh"), 500);
  EXPECT_EQ(stages.at("front"), 0);
  EXPECT_EQ(stages.at("rest"), 20);
}

std::string without(std::string text, const std::string& words) {
  const auto at = text.find(words);
  EXPECT_NE(at, std::string::npos);
  return text.erase(at, words.size());
}

TEST(StageInstructionsTest, AnInlinedStageIsAnErrorAndNotZero) {
  // The function is inlined into the caller: the calls are gone, and their cost belongs to the caller.
  std::string inlined = profile;
  const std::string calls = "cfn=(6)\ncalls=1 +3\n0 50\n";
  inlined = without(inlined, calls);
  const std::string first =
      "cfn=(6) ccdt::delaunay::build_delaunay(std::span<ccdt::Point3>) [clone .avx2]\ncalls=1 0\n";
  inlined = without(inlined, first);
  inlined = without(inlined, inlined.substr(inlined.find("fn=(6)"), inlined.find("fn=(8)\n") - inlined.find("fn=(6)")));
  inlined = without(inlined, "fn=(8)\n0 150\n");
  EXPECT_THROW(stage_instructions(inlined), InputError);
}

TEST(StageInstructionsTest, AProfileOfAnotherProgramIsAnError) {
  EXPECT_THROW(stage_instructions("version: 1\npositions: line\nevents: Ir\nfn=(1) main\n0 10\n"), InputError);
}

TEST(CallgrindProfileTest, OtherFilesAreErrors) {
  EXPECT_THROW(read_callgrind(""), InputError);
  EXPECT_THROW(read_callgrind("{\"schema\": \"ccdt.run/1\"}"), InputError);
  EXPECT_THROW(read_callgrind("positions: instr line\nevents: Ir\n"), InputError);
  EXPECT_THROW(read_callgrind("positions: line\nevents: Ir\nfn=(1)\n"), InputError);
  EXPECT_THROW(read_callgrind("positions: line\nevents: Ir\nfn=(1) a\ncfn=(2) b\ncalls=1 0\nfn=(2)\n"), InputError);
}

TEST(CallgrindProfileTest, BareNamesAreThoseOfFunctionsAlone) {
  EXPECT_EQ(bare_name("a::f(int, std::function<void (int)>)"), "a::f");
  EXPECT_EQ(bare_name("main"), "main");
  EXPECT_EQ(bare_name("a::f(int)::{lambda()#1}::operator()() const"), "a::f(int)::{lambda()#1}::operator()() const");
  EXPECT_NE(bare_name("a::(anonymous namespace)::f(int)"), "a");
}

/// With the program that was built, on a small input.
class InstructionsTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!baselines::find_on_path("valgrind")) GTEST_SKIP() << "there is no valgrind here";
#ifndef NDEBUG
    GTEST_SKIP() << "CGAL's assertions test modes of rounding, which Valgrind does not have";
#endif
    baselines::run_program({CCDT_PROGRAM, "model", "cube", "--edge-length", "0.5", "-o", input().string()});
  }

  std::filesystem::path input() const {
    return folder_.path() / "cube.off";
  }

  Recording record(const std::filesystem::path& program, const std::string& options) const {
    Recording recording;
    std::vector<bench::Case> cases(3);
    for (bench::Case& c : cases) c.input = input();
    cases[0].name = "cube";
    cases[0].options = {"--lattice", options};
    cases[1].name = "other mesher";
    cases[1].mesher = "tetgen";
    cases[2].name = "not named by the rules";
    Rules rules;
    rules.instructions.cases = {"cub*", "other*"};
    add_instructions(program, cases, rules, folder_.path(), recording);
    return recording;
  }

  const std::filesystem::path& folder() const {
    return folder_.path();
  }

 private:
  baselines::TemporaryFolder folder_;
};

double samples_of(const Recording& recording, const std::string& name) {
  const auto& figures = recording.cases.at(0).figures;
  const auto found = std::ranges::find(figures, name, &Figure::name);
  return found == figures.end() ? -1 : found->samples.at(0);
}

TEST_F(InstructionsTest, StagesOfARealRunAreCounted) {
  const Recording recording = record(CCDT_PROGRAM, "fcc");
  ASSERT_EQ(recording.cases.size(), 1u);
  EXPECT_EQ(recording.cases[0].name, "cube");
  for (const char* stage :
       {"plc", "protect", "facets", "lattice", "delaunay", "face_check", "front", "label", "finish"})
    EXPECT_GT(samples_of(recording, std::string("instructions.") + stage), 0) << stage;
  EXPECT_GT(samples_of(recording, "instructions.mesh"), samples_of(recording, "instructions.delaunay"));
  for (const char* field : {"cpu", "valgrind", "libc", "libstdc++", "compiler", "flags"})
    EXPECT_TRUE(recording.identity.contains(std::string("instructions.") + field)) << field;
}

TEST_F(InstructionsTest, CountsDependNeitherOnTheFolderNorOnTheEnvironment) {
  const Recording first = record(CCDT_PROGRAM, "none");
  const auto copy = folder() / "a_folder_with_a_long_name" / "ccdt_of_another_name";
  std::filesystem::create_directory(copy.parent_path());
  std::filesystem::copy_file(CCDT_PROGRAM, copy);
  setenv("A_LONG_VARIABLE", std::string(3001, 'x').c_str(), 1);
  const Recording second = record(copy, "none");
  unsetenv("A_LONG_VARIABLE");
  for (const Figure& figure : first.cases.at(0).figures)
    EXPECT_EQ(figure.samples.at(0), samples_of(second, figure.name)) << figure.name;
  EXPECT_EQ(first.identity, second.identity);
}

TEST_F(InstructionsTest, AProgramThatIsNotOursIsAnInputError) {
  EXPECT_THROW(record("/bin/true", "fcc"), InputError);
}

TEST_F(InstructionsTest, ACaseThatFailsIsAMeshError) {
  EXPECT_THROW(record(CCDT_PROGRAM, "unknown"), MeshError);
}

TEST(InstructionIdentityTest, WithoutValgrindTheErrorSaysSo) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  EXPECT_THROW(instruction_identity(CCDT_PROGRAM), InputError);
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace ccdt::gate
