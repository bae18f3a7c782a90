#include "baselines/mesher_description.h"

#include <gtest/gtest.h>

#include <fstream>

#include "baselines/external_program.h"
#include "baselines/mesher.h"
#include "engine/base/errors.h"

namespace ccdt {
namespace {

using Names = std::vector<std::string>;

TEST(Placeholders, AreSmallLettersInBracesAndNothingElse) {
  EXPECT_EQ(baselines::placeholders_in("-pa{max_volume} {input}"), (Names{"max_volume", "input"}));
  EXPECT_EQ(baselines::placeholders_in("Surface Loop(1) = {1}; { input } {} {Input} {in"), Names{});
  EXPECT_EQ(baselines::placeholders_in("{{input}}"), Names{"input"});
}

TEST(Placeholders, AreReplacedWhereTheyAreKnown) {
  const std::vector<baselines::Placeholder> values = {{"input", "part.off"}, {"stem", ""}};
  EXPECT_EQ(baselines::fill_placeholders("{input}", values), "part.off");
  EXPECT_EQ(baselines::fill_placeholders("a{stem}b {1} {input}{input}; {other}", values),
            "ab {1} part.offpart.off; {other}");
  EXPECT_EQ(baselines::fill_placeholders("", values), "");
}

class Descriptions : public testing::Test {
 protected:
  std::string write(const std::string& text) const {
    const auto file = folder_.path() / "mine.json";
    std::ofstream(file) << text;
    return file.string();
  }

  /// A good description, with one thing replaced.
  std::string with(const std::string& what, const std::string& instead) const {
    std::string text = R"({"schema": "ccdt.mesher/1", "name": "mine", "what": "a mesher", "licence": "MIT",
      "command": ["./mine", "{input}"], "input_format": "off", "output": "out.vtu"})";
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return write(text.replace(at, what.size(), instead));
  }

  static void expect_refused(const std::string& file, const std::string& pointer) {
    try {
      baselines::read_mesher_description(file);
      FAIL() << "not refused: " << pointer;
    } catch (const InputError& error) {
      EXPECT_EQ(error.place().file, file);
      EXPECT_TRUE(std::string(error.what()).starts_with(pointer)) << error.what();
      EXPECT_NE(error.remedy(), "");
    }
  }

 private:
  baselines::TemporaryFolder folder_;
};

TEST_F(Descriptions, OfTheLeastThatIsNeededHasDefaults) {
  const baselines::MesherDescription d = baselines::read_mesher_description(with("mine", "mine-2"));
  EXPECT_EQ(d.name, "mine-2");
  EXPECT_EQ(d.command, (Names{"./mine", "{input}"}));
  EXPECT_EQ(d.success_codes, std::vector<int>{0});
  EXPECT_TRUE(d.keeps_surface);
  EXPECT_TRUE(d.files.empty() && d.choices.empty() && d.seconds_pattern.empty());
}

TEST_F(Descriptions, OfEverythingSayEverything) {
  const baselines::MesherDescription d =
      baselines::read_mesher_description(with(R"("output")", R"json("install": "buy it",
    "choices": {"fine": {"if": "improvement", "then": "{edge_length}"}}, "success_codes": [0, 3],
    "keeps_surface": false,
    "files": {"a.txt": ["one {fine}", "two"], "b.txt": "three"}, "environment": {"THREADS": "1"},
    "version_command": ["mine", "-v"], "version_pattern": "v(.*)", "seconds_pattern": "([0-9.]+) s",
    "output")json"));
  EXPECT_EQ(d.install, "buy it");
  ASSERT_EQ(d.choices.size(), 1u);
  EXPECT_EQ(d.choices[0].condition, baselines::ChoiceCondition::improvement);
  EXPECT_EQ(d.choices[0].text_if, "{edge_length}");
  EXPECT_EQ(d.choices[0].text_else, "");
  ASSERT_EQ(d.files.size(), 2u);
  EXPECT_EQ(d.files[0].second, "one {fine}\ntwo\n");
  EXPECT_EQ(d.files[1].second, "three");
  EXPECT_EQ(d.environment.at(0).first, "THREADS");
  EXPECT_EQ(d.version_command.size(), 2u);
  EXPECT_EQ(d.seconds_pattern, "([0-9.]+) s");
  EXPECT_EQ(d.success_codes, (std::vector<int>{0, 3}));
  EXPECT_FALSE(d.keeps_surface);
}

TEST_F(Descriptions, ThatAreWrongAreRefusedAtTheJsonPointer) {
  expect_refused(with("ccdt.mesher/1", "ccdt.mesher/2"), "/schema: ");
  expect_refused(with(R"("name": "mine", )", ""), "Missing required property 'name'");
  expect_refused(with("mine", "My Mesher"), "/name: ");
  expect_refused(with(R"("MIT")", "1"), "/licence: ");
  expect_refused(with("{input}", "{inptu}"), "/command/1: there is no placeholder {inptu}");
  expect_refused(with(R"("./mine")", R"("{here}/mine")"), "/command/0: ");
  expect_refused(with(R"(["./mine", "{input}"])", "[]"), "/command: ");
  expect_refused(with(R"("off")", R"("step")"), "/input_format: ");
  expect_refused(with("out.vtu", "out.vtk"), "/output: ");
  expect_refused(with(R"("what")", R"("wath": 1, "what")"), "/wath: ");
  expect_refused(with(R"("what")", R"("choices": {"input": {"if": "regions", "then": ""}}, "what")"), "/choices: ");
  expect_refused(with(R"("what")", R"("choices": {"a": {"if": "weather", "then": ""}}, "what")"), "/choices/a/if: ");
  expect_refused(with(R"("what")", R"("choices": {"a": {"if": "regions"}}, "what")"),
                 "/choices/a: Missing required property 'then'");
  expect_refused(with(R"("what")", R"("files": {"a/b": ""}, "what")"), "/files: ");
  expect_refused(with(R"("what")", R"json("seconds_pattern": "(", "what")json"), "/seconds_pattern: ");
  expect_refused(with(R"("what")", R"("version_command": ["a", "{input}"], "what")"), "/version_command/1: ");
  expect_refused(with(R"("what")", R"("success_codes": [0, 300], "what")"), "/success_codes/1: ");
  expect_refused(write("[]"), "Value type not permitted");
}

TEST_F(Descriptions, ThatAreNoJsonAreRefusedAtTheByte) {
  try {
    baselines::read_mesher_description(write("{\"schema\": }"));
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().byte, 12);
  }
  EXPECT_THROW(baselines::read_mesher_description("/nowhere/mine.json"), InputError);
}

TEST_F(Descriptions, MayNotTakeTheNameOfAMesherOfTheBuild) {
  EXPECT_THROW(baselines::mesher(with("mine", "ccdt")), InputError);
}

TEST_F(Descriptions, OfTheProjectAreRight) {
  for (const char* name : {"tetgen-program", "gmsh-delaunay"}) {
    const std::string file = std::string(DESCRIBED_FOLDER) + "/" + name + ".json";
    EXPECT_EQ(baselines::mesher(file).name, name);
    EXPECT_EQ(&baselines::mesher(file), &baselines::mesher(file)) << "it is read once";
  }
}

TEST_F(Descriptions, NameFilesByWholePaths) {
  const std::string file = with(R"("out.vtu")", R"("out.vtu", "environment": {"LIBRARY": "/nowhere:{here}/library"},
    "files": {"run.sh": ["sh {here}/run.sh <{here}/missing"]},
    "choices": {"size": {"if": "edge_length", "then": "--table={here}/table"}})");
  const auto folder = std::filesystem::path(file).parent_path();
  for (const char* name : {"library", "run.sh", "table", "mine", "unrelated"}) std::ofstream(folder / name) << name;
  const auto files = baselines::files_named_in(baselines::read_mesher_description(file));
  EXPECT_EQ(files, (std::vector<std::filesystem::path>{folder / "library", folder / "run.sh", folder / "table"}));
}

}  // namespace
}  // namespace ccdt
