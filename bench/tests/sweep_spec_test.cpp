#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "baselines/external_program.h"
#include "bench/run/identity.h"
#include "bench/sweep/expand.h"
#include "bench/sweep/spec.h"
#include "bench/sweep/sweep_document.h"
#include "engine/base/errors.h"

namespace ccdt {
namespace {

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

/// A command line with few options.
sweep::MeshOptionRules some_rules() {
  return {{"lattice", "locator", "improve", "edge-length", "face-protection", "threads", "surface"},
          [](const std::string& name, const std::string& value) {
            return name == "lattice" && value == "hcp" ? std::string("there is no such lattice") : std::string();
          },
          [](const Texts& words) {
            const bool remeshes = std::ranges::find(words, "remesh") != words.end();
            const bool has_length = std::ranges::find(words, "--edge-length") != words.end();
            return remeshes && !has_length ? std::string("remeshing takes an edge length") : std::string();
          }};
}

class SweepSpecs : public testing::Test {
 protected:
  std::filesystem::path folder() const { return folder_.path(); }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder() / name).parent_path());
    std::ofstream(folder() / name) << text;
  }

  /// The smallest possible spec, with these members added or replaced.
  static Json spec_with(const Json& members) {
    Json spec = {{"schema", "ccdt.sweep/1"}, {"inputs", {{{"model", "cube"}, {"edge_length", 0.5}}}}};
    spec.update(members);
    return spec;
  }

  sweep::SweepSpec read(const Json& spec) const {
    write("spec.json", spec.dump());
    return sweep::read_spec(folder() / "spec.json", some_rules());
  }

  std::vector<sweep::SweepCase> expand(const Json& spec) const {
    return sweep::expand(read(spec), folder() / "out", some_rules());
  }

  Texts names(const Json& spec) const {
    Texts names;
    for (const sweep::SweepCase& one : expand(spec)) names.push_back(one.asked.name);
    return names;
  }

  void expect_refused(const Json& spec, const std::string& pointer) const {
    try {
      expand(spec);
      FAIL() << "not refused: " << pointer;
    } catch (const InputError& error) {
      EXPECT_EQ(error.place().file, (folder() / "spec.json").string());
      EXPECT_TRUE(std::string(error.what()).starts_with(pointer + ": ")) << error.what();
      EXPECT_NE(error.remedy(), "");
    }
  }

 private:
  baselines::TemporaryFolder folder_;
};

TEST_F(SweepSpecs, HaveDefaults) {
  const sweep::SweepSpec spec = read(spec_with(Json::object()));
  EXPECT_EQ(spec.name, "spec");
  EXPECT_EQ(spec.seed, 1u);
  EXPECT_EQ(spec.meshers, Texts{"ccdt"});
  EXPECT_EQ(spec.repetitions.at_least, 1);
  EXPECT_EQ(spec.repetitions.warm_up, 0);
  EXPECT_FALSE(spec.verify || spec.keep_meshes);
  EXPECT_GT(spec.limits.seconds, 0);
}

TEST_F(SweepSpecs, SayHowOftenToRepeat) {
  const sweep::SweepSpec five = read(spec_with({{"repetitions", 5}}));
  EXPECT_EQ(five.repetitions.at_least, 5);
  EXPECT_EQ(five.repetitions.at_most, 5);
  EXPECT_EQ(five.repetitions.warm_up, 1);
  const sweep::SweepSpec until =
      read(spec_with({{"repetitions", {{"until", 0.05}, {"at_least", 3}, {"at_most", 9}}}, {"warm_up", 0}}));
  EXPECT_EQ(until.repetitions.until, 0.05);
  EXPECT_EQ(until.repetitions.at_least, 3);
  EXPECT_EQ(until.repetitions.at_most, 9);
  EXPECT_EQ(until.repetitions.warm_up, 0);
}

TEST_F(SweepSpecs, HaveRangesWithEqualRatiosOrDifferences) {
  const auto lengths = [&](const Json& range) {
    return read(spec_with({{"inputs", {{{"model", "cube"}, {"edge_length", range}}}}})).inputs.at(0).edge_lengths;
  };
  using Lengths = std::vector<double>;
  EXPECT_EQ(lengths({{"from", 0.8}, {"to", 0.1}, {"steps", 4}, {"scale", "log"}}), (Lengths{0.8, 0.4, 0.2, 0.1}));
  EXPECT_EQ(lengths({{"from", 0.8}, {"to", 0.1}, {"steps", 3}, {"scale", "log"}}), (Lengths{0.8, 0.2828, 0.1}));
  EXPECT_EQ(lengths({{"from", 0.2}, {"to", 0.8}, {"steps", 3}, {"scale", "linear"}}), (Lengths{0.2, 0.5, 0.8}));
}

TEST_F(SweepSpecs, ThatAreWrongAreRefusedAtTheJsonPointer) {
  expect_refused(spec_with({{"lattise", 1}}), "/lattise");
  expect_refused(spec_with({{"schema", "ccdt.sweep/2"}}), "/schema");
  expect_refused(spec_with({{"inputs", {{{"model", "cube"}, {"edgelength", 1}}}}}), "/inputs/0/edgelength");
  expect_refused(spec_with({{"inputs", {{{"model", "cueb"}}}}}), "/inputs/0/model");
  expect_refused(spec_with({{"inputs", {{{"model", "cube"}, {"edge_length", -1}}}}}), "/inputs/0/edge_length");
  expect_refused(spec_with({{"inputs", {{{"model", "cube"}, {"edge_length", {{"from", 1}, {"to", 2}}}}}}}),
                 "/inputs/0/edge_length");
  expect_refused(spec_with({{"inputs", {{{"model", "cube"}, {"edge_length", {{"form", 1}}}}}}}),
                 "/inputs/0/edge_length/form");
  expect_refused(spec_with({{"inputs", {{{"model", "cube"}, {"edge_length", 1e-9}}}}}), "/inputs/0/edge_length");
  expect_refused(spec_with({{"inputs", {{{"files", "*.off"}}}}}), "/inputs/0/files");
  expect_refused(spec_with({{"inputs", {{{"files", Json::array()}}}}}), "/inputs/0/files");
  expect_refused(spec_with({{"inputs", {Json::object()}}}), "/inputs/0");
  expect_refused(spec_with({{"inputs", Json::array()}}), "/inputs");
  expect_refused(spec_with({{"meshers", {"ccdt", "tetgn"}}}), "/meshers/1");
  expect_refused(spec_with({{"meshers", Json::array()}}), "/meshers");
  expect_refused(spec_with({{"options", {{"latice", "fcc"}}}}), "/options/latice");
  expect_refused(spec_with({{"options", {{"lattice", {"fcc", "hcp"}}}}}), "/options/lattice/1");
  expect_refused(spec_with({{"options", {{"lattice", Json::array()}}}}), "/options/lattice");
  expect_refused(spec_with({{"options", {{"surface", "remesh"}}}}), "/options");
  expect_refused(spec_with({{"exclude", {{{"mesher", "ccdt"}}}}}), "/exclude");
  expect_refused(spec_with({{"exclude", {{{"mehser", "ccdt"}}}}}), "/exclude/0/mehser");
  expect_refused(spec_with({{"repetitions", 0}}), "/repetitions");
  expect_refused(spec_with({{"repetitions", {{"until", 0.1}, {"at_least", 9}, {"at_most", 8}}}}),
                 "/repetitions/at_most");
  expect_refused(spec_with({{"repetitions", {{"until", 0.1}, {"at_most", 5}}}}), "/repetitions/at_most");
  expect_refused(spec_with({{"limits", {{"second", 1}}}}), "/limits/second");
  expect_refused(spec_with({{"verify", "yes"}}), "/verify");
}

TEST_F(SweepSpecs, SuggestTheNameThatWasMeant) {
  try {
    read(spec_with({{"repetition", 5}}));
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(error.remedy().find("'repetitions'"), std::string::npos) << error.remedy();
  }
}

TEST_F(SweepSpecs, ThatAreNoJsonAreRefusedAtTheByte) {
  write("spec.json", "{\"schema\": }");
  try {
    sweep::read_spec(folder() / "spec.json", some_rules());
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().byte, 12);
  }
}

TEST_F(SweepSpecs, ExpandToAllCombinationsInTheirOrder) {
  const Json spec = spec_with({{"inputs", {{{"model", "cube"}, {"edge_length", {0.5, 0.25}}}}},
                               {"options", {{"lattice", {"fcc", "bcc"}}, {"face-protection", {true, false}}}}});
  const Texts all = names(spec);
  ASSERT_EQ(all.size(), 8u);
  EXPECT_EQ(all[0], "cube-0.5, ccdt, lattice fcc, face-protection on");
  EXPECT_EQ(all[1], "cube-0.5, ccdt, lattice fcc, face-protection off");
  EXPECT_EQ(all[2], "cube-0.5, ccdt, lattice bcc, face-protection on");
  EXPECT_EQ(all[7], "cube-0.25, ccdt, lattice bcc, face-protection off");
  EXPECT_EQ(names(spec), all);
}

TEST_F(SweepSpecs, RunCasesOfOneInputInTurns) {
  for (const sweep::SweepCase& one : expand(spec_with({{"inputs", {{{"model", "cube"}, {"edge_length", {0.5, 0.25}}}}},
                                                       {"options", {{"lattice", {"fcc", "bcc"}}}}})))
    EXPECT_EQ(one.asked.group, one.input.name);
}

TEST_F(SweepSpecs, LeaveOutWhatIsExcluded) {
  const Json all = {{"inputs", {{{"model", "cube"}, {"edge_length", {0.5, 0.25}}}}},
                    {"options", {{"lattice", {"fcc", "bcc", "none"}}}}};
  const auto count = [&](const Json& exclusion) {
    Json members = all;
    members["exclude"] = Json::array({exclusion});
    return expand(spec_with(members)).size();
  };
  EXPECT_EQ(expand(spec_with(all)).size(), 6u);
  EXPECT_EQ(count({{"lattice", "bcc"}}), 4u);
  EXPECT_EQ(count({{"lattice", {"bcc", "none"}}}), 2u);
  EXPECT_EQ(count({{"lattice", "bcc"}, {"edge_length", 0.25}}), 5u);
  EXPECT_EQ(count({{"input", "cube-0.2*"}}), 3u);
  EXPECT_EQ(count({{"model", "piston"}}), 6u);
  EXPECT_EQ(count({{"mesher", "ccdt"}, {"lattice", "none"}}), 4u);
}

TEST_F(SweepSpecs, FindFilesByWildcardsAndFolders) {
  for (const char* name : {"parts/b.off", "parts/a.stl", "parts/notes.txt", "more/a.stl"}) write(name, "");
  const auto inputs = [&](const Json& files) {
    Texts names;
    for (const sweep::SweepCase& one : expand(spec_with({{"inputs", {{{"files", files}}}}})))
      names.push_back(one.input.name);
    return names;
  };
  EXPECT_EQ(inputs("parts/*.off"), Texts{"b.off"});
  EXPECT_EQ(inputs("parts"), (Texts{"a.stl", "b.off"}));
  EXPECT_EQ(inputs({"parts/b.off", "parts/*"}).size(), 3u);
  EXPECT_EQ(inputs({"parts", "more"}), (Texts{"parts/a.stl", "b.off", "more/a.stl"}));
}

TEST_F(SweepSpecs, MayHaveOptionsForOneInputAlone) {
  const auto cases =
      expand(spec_with({{"inputs",
                         {{{"model", "cube"}, {"edge_length", 0.5}},
                          {{"model", "sphere"}, {"edge_length", 0.5}, {"options", {{"lattice", "none"}}}}}},
                        {"options", {{"lattice", {"fcc", "bcc"}}}}}));
  ASSERT_EQ(cases.size(), 3u);
  EXPECT_EQ(cases[2].asked.options, (Texts{"--lattice", "none"}));
}

TEST_F(SweepSpecs, TakeTheUsersFilesInsteadOfTheirOwn) {
  write("parts/a.off", "");
  write("mine.off", "");
  sweep::SweepSpec spec = read(spec_with({{"inputs", {{{"model", "cube"}}, {{"files", "parts/*.off"}}}}}));
  sweep::replace_files(spec, {(folder() / "mine.off").string()});
  const auto cases = sweep::expand(spec, folder() / "out", some_rules());
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].input.model, "cube");
  EXPECT_EQ(cases[1].input.name, "mine.off");
}

/// A program that has no options but the edge length.
TEST_F(SweepSpecs, MakeOneCaseOfOptionsThatAMesherDoesNotHave) {
  write("other.json", Json{{"schema", "ccdt.mesher/1"},
                           {"name", "other"},
                           {"what", "a mesher"},
                           {"licence", "MIT"},
                           {"command", {"other", "{input}", "{edge_length}"}},
                           {"input_format", "off"},
                           {"output", "out.vtu"}}
                          .dump());
  const auto cases =
      expand(spec_with({{"meshers", {"ccdt", "other.json"}},
                        {"options", {{"locator", {"cavity", "octree", "grid"}}, {"edge-length", {0.5, 0.25}}}}}));
  ASSERT_EQ(cases.size(), 8u);
  EXPECT_EQ(cases[6].mesher, "other");
  EXPECT_EQ(cases[6].asked.options, (Texts{"--edge-length", "0.5"}));
  EXPECT_EQ(cases[7].asked.options, (Texts{"--edge-length", "0.25"}));
  // A default value is not passed to the mesher, but it is in reports.
  EXPECT_EQ(cases[0].asked.options, (Texts{"--edge-length", "0.5"}));
  EXPECT_EQ(cases[0].options,
            (std::vector<std::pair<std::string, std::string>>{{"edge-length", "0.5"}, {"locator", "cavity"}}));
}

TEST_F(SweepSpecs, IdentifyCasesWhateverTheOrderOfTheOptions) {
  bench::FileHashes hashes;
  const auto id = [&](const Json& options) {
    return bench::id_of(expand(spec_with({{"options", options}})).at(0).asked, {}, hashes);
  };
  EXPECT_EQ(id({{"lattice", "bcc"}, {"locator", "grid"}}), id({{"locator", "grid"}, {"lattice", "bcc"}}));
  EXPECT_EQ(id({{"lattice", "fcc"}}), id(Json::object()));
  EXPECT_EQ(id({{"edge-length", 0.5}}), id({{"edge-length", "0.50"}}));
  EXPECT_NE(id({{"lattice", "bcc"}}), id({{"lattice", "sc"}}));
}

TEST_F(SweepSpecs, AreKeptInTheFolderWithTheirCases) {
  write("part.off", "");
  const Json spec = spec_with({{"inputs", {{{"model", "cube"}}, {{"files", "part.off"}}}},
                               {"options", {{"lattice", {"fcc", "bcc"}}}},
                               {"repetitions", {{"until", 0.1}}},
                               {"limits", {{"seconds", 7}, {"bytes", 8}, {"disk_bytes", 9}}},
                               {"seed", 12},
                               {"verify", true},
                               {"keep_meshes", true}});
  auto cases = expand(spec);
  for (std::size_t i = 0; i < cases.size(); ++i) cases[i].id = std::to_string(i);
  const std::vector<bench::Identity> identities = {{{"ccdt.binary", "b"}}, {{"ccdt.binary", "a"}}};
  std::filesystem::create_directories(folder() / "out");
  sweep::write_sweep(folder() / "out", read(spec), identities, cases);

  const sweep::SweepDocument document = sweep::read_sweep(folder() / "out");
  EXPECT_EQ(document.seed, 12u);
  EXPECT_EQ(document.identities, identities);
  ASSERT_EQ(document.cases.size(), cases.size());
  const std::vector<bench::Case> asked = sweep::asked_of(document.cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const bench::Case &then = cases[i].asked, &now = asked[i];
    EXPECT_EQ(document.cases[i].id, cases[i].id);
    EXPECT_EQ(document.cases[i].options, cases[i].options);
    EXPECT_EQ(now.name, then.name);
    EXPECT_EQ(now.group, then.group);
    EXPECT_EQ(now.input, then.input);
    EXPECT_EQ(now.options, then.options);
    EXPECT_EQ(now.limits.seconds, 7);
    EXPECT_EQ(now.limits.memory_bytes, 8u);
    EXPECT_EQ(now.limits.disk_bytes, 9u);
    EXPECT_EQ(now.repetitions.until, 0.1);
    EXPECT_EQ(now.mesh_ending, then.mesh_ending);
    EXPECT_TRUE(now.verify);
  }
  cases.pop_back();
  cases[0].id = "new";
  const sweep::SweepChanges changes = sweep::changes_since(document, cases);
  EXPECT_EQ(changes.added, Texts{cases[0].asked.name});
  EXPECT_EQ(changes.obsolete.size(), 2u);
}

TEST_F(SweepSpecs, ThatWereWrittenCanBeReadAgain) {
  const sweep::SweepSpec spec = read(spec_with({{"options", {{"lattice", {"fcc", "bcc"}}, {"threads", 2}}},
                                                {"exclude", {{{"lattice", "bcc"}, {"threads", 1}}}},
                                                {"repetitions", 3}}));
  const Json resolved = sweep::to_json(spec);
  EXPECT_EQ(sweep::to_json(read(resolved)), resolved);
}

}  // namespace
}  // namespace ccdt
