#include "baselines/mesher_options.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "baselines/known_meshers.h"
#include "engine/options/option_table.h"

namespace ccdt {
namespace {

using baselines::effective_options;
using baselines::Mesher;
using baselines::NamedOptions;

const Mesher& ccdt_mesher() {
  return baselines::mesher("ccdt");
}

/// A mesher like TetGen: from the lattice option it learns only whether interior points are wanted.
Mesher refiner() {
  Mesher mesher;
  mesher.name = "refiner";
  mesher.options = {{.name = "edge-length", .only_inside = true}, {.name = "lattice", .only_none = true}};
  return mesher;
}

/// A mesher like Mesh_3: it always has interior points.
Mesher remesher() {
  Mesher mesher;
  mesher.name = "remesher";
  mesher.keeps_surface = false;
  mesher.options = {{.name = "edge-length"}, {.name = "improve", .only_none = true}};
  return mesher;
}

/// Values that the option can have, as on the command line.
std::vector<std::string> values_of(const options::MeshOption& option) {
  const auto* choice = std::get_if<options::ChoiceKind>(&option.kind);
  if (choice == nullptr) return {"2", "3"};
  std::vector<std::string> names;
  for (const auto& name : choice->names) names.emplace_back(name.name);
  return names;
}

TEST(OptionTable, EachOptionHasTheValueThatWasSetAndChangesNoOther) {
  for (const options::MeshOption& option : options::mesh_options())
    for (const std::string& value : values_of(option)) {
      MeshOptions before, after;
      if (option.name == "lattice") before.improve.improvement = after.improve.improvement = Improvement::all;
      set_value(option, value, after);
      EXPECT_EQ(options::text_of(recorded_value(option, after)), value) << option.name;
      for (const options::MeshOption& other : options::mesh_options()) {
        if (&other == &option) continue;
        EXPECT_EQ(recorded_value(other, after), recorded_value(other, before)) << option.name << ", " << other.name;
      }
    }
}

TEST(OptionTable, NeedsOnlyOptionsAndValuesThatExist) {
  for (const options::MeshOption& option : options::mesh_options())
    for (const options::Need& need : option.needs) {
      const options::MeshOption* const other = options::find_mesh_option(need.option);
      ASSERT_NE(other, nullptr) << option.name;
      EXPECT_TRUE(std::ranges::count(values_of(*other), need.value)) << option.name << " needs " << need.value;
    }
}

TEST(EffectiveOptions, OnlyCcdtRefinesSurfaces) {
  const NamedOptions refined = {{"edge-length", "2"}, {"grading", "0.3"}, {"lattice", "none"}, {"surface", "refine"}};
  EXPECT_EQ(effective_options(ccdt_mesher(), refined), refined);
  EXPECT_FALSE(effective_options(remesher(), refined).contains("surface"));
}

TEST(EffectiveOptions, OfOurEngineAreAllButTheUsualOnes) {
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"lattice", "fcc"}, {"face-protection", "off"}}),
            (NamedOptions{{"face-protection", "off"}}));
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"lattice", "bcc"}, {"threads", "4"}, {"grading", "0.50"}}),
            (NamedOptions{{"lattice", "bcc"}, {"threads", "4"}}));
  EXPECT_EQ(effective_options(ccdt_mesher(), baselines::usual_options()), NamedOptions());
}

TEST(EffectiveOptions, OfThePapersStrategiesAreThoseThatTheyStandFor) {
  const NamedOptions paper = {{"delaunay", "wrap"},
                              {"improve", "swap-smooth"},
                              {"locator", "grid"},
                              {"protection", "midpoint"},
                              {"visibility", "faces"}};
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"strategies", "paper"}}), paper);
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"strategies", "PAPER"}}), paper);
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"strategies", "default"}}), NamedOptions());
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"strategies", "paper"}, {"locator", "octree"}}).at("locator"), "octree");
  EXPECT_FALSE(effective_options(ccdt_mesher(), {{"strategies", "paper"}, {"lattice", "none"}}).contains("improve"));
  EXPECT_EQ(effective_options(remesher(), {{"strategies", "paper"}}), NamedOptions());
}

TEST(EffectiveOptions, HaveABoundOfRefinementOnlyWithRefinement) {
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"radius-edge", "1.5"}}), NamedOptions());
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"lattice", "refinement"}, {"radius-edge", "1.5"}}).size(), 2u);
}

TEST(EffectiveOptions, WriteEqualNumbersAndNamesAlike) {
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"edge-length", "2.50"}, {"lattice", "BCC"}, {"sizes", "Part.sol"}}),
            (NamedOptions{{"edge-length", "2.5"}, {"lattice", "bcc"}, {"sizes", "Part.sol"}}));
}

TEST(EffectiveOptions, WithoutInteriorPointsAreThoseOfTheSurfaceAndOfImprovement) {
  const NamedOptions no_lattice = {{"lattice", "none"}};
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"lattice", "none"}, {"edge-length", "2"}, {"grading", "1"}}),
            no_lattice);
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"lattice", "none"}, {"improve", "none"}, {"target-r", "3"}}),
            no_lattice);
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"lattice", "none"}, {"improve", "all"}}),
            (NamedOptions{{"improve", "all"}, {"lattice", "none"}}));
  const NamedOptions remeshed = {{"edge-length", "2"}, {"lattice", "none"}, {"surface", "remesh"}};
  EXPECT_EQ(effective_options(ccdt_mesher(), remeshed), remeshed);
}

TEST(EffectiveOptions, ThatNobodyLooksAtAreDropped) {
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"improve", "none"}, {"objective", "dihedral"}}),
            (NamedOptions{{"improve", "none"}}));
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"objective", "dihedral"}, {"target-r", "3"}}),
            (NamedOptions{{"objective", "dihedral"}}));
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"sharp-angle", "30"}}), NamedOptions());
  EXPECT_EQ(effective_options(ccdt_mesher(), {{"sharp-angle", "20"}, {"surface", "remesh"}}).size(), 2u);
}

TEST(EffectiveOptions, OfAMesherThatKnowsNoLatticesDistinguishOnlyNone) {
  EXPECT_EQ(effective_options(refiner(), {{"lattice", "bcc"}, {"improve", "swap"}, {"face-protection", "off"}}),
            NamedOptions());
  EXPECT_EQ(effective_options(refiner(), {{"lattice", "none"}, {"edge-length", "3"}}),
            (NamedOptions{{"lattice", "none"}}));
  EXPECT_EQ(effective_options(refiner(), {{"lattice", "sc"}, {"edge-length", "3"}}),
            (NamedOptions{{"edge-length", "3"}}));
}

TEST(EffectiveOptions, SayWhatImprovementDoesWhereTheLatticeDecidesThat) {
  EXPECT_EQ(effective_options(remesher(), {{"lattice", "none"}}), (NamedOptions{{"improve", "none"}}));
  EXPECT_EQ(effective_options(remesher(), {{"lattice", "none"}, {"improve", "smooth"}}), NamedOptions());
  Mesher both = remesher();
  both.options.push_back({.name = "lattice", .only_none = true});
  EXPECT_EQ(effective_options(both, {{"lattice", "none"}}), (NamedOptions{{"lattice", "none"}}));
  EXPECT_EQ(effective_options(both, {{"lattice", "none"}, {"improve", "smooth"}}),
            (NamedOptions{{"improve", "all"}, {"lattice", "none"}}));
}

TEST(EffectiveOptions, AreAlwaysThoseOfTheSurfaceForItIsRemeshedBefore) {
  const NamedOptions remeshed = {{"edge-length", "2"}, {"flatness", "1e-06"}, {"surface", "remesh"}};
  Mesher bare = refiner();
  bare.options.clear();
  EXPECT_EQ(effective_options(bare, remeshed), remeshed);
  EXPECT_EQ(effective_options(bare, {{"edge-length", "2"}, {"flatness", "1e-06"}}), NamedOptions());
}

TEST(EffectiveOptions, HaveTheSameEffectAgain) {
  for (const Mesher& mesher : baselines::meshers())
    for (const NamedOptions& options : std::vector<NamedOptions>{{{"lattice", "none"}, {"edge-length", "2"}},
                                                                 {{"lattice", "bcc"}, {"improve", "swap"}},
                                                                 {{"lattice", "none"}, {"improve", "swap"}},
                                                                 {{"surface", "remesh"}, {"sharp-angle", "20"}}}) {
      const NamedOptions once = effective_options(mesher, options);
      EXPECT_EQ(effective_options(mesher, once), once) << mesher.name;
    }
}

/// The options that a mesher uses according to its description.
NamedOptions uses(const baselines::MesherDescription& description) {
  NamedOptions names;
  for (const auto& use : baselines::described_mesher(description).options)
    names[use.name] = use.only_inside ? "inside" : use.only_none ? "none" : "";
  return names;
}

TEST(EffectiveOptions, OfADescribedMesherFollowFromItsPlaceholders) {
  baselines::MesherDescription d;
  d.command = {"mine", "{input}"};
  d.input_format = "poly";
  EXPECT_EQ(uses(d), NamedOptions());
  d.input_format = "stl";
  EXPECT_EQ(uses(d), (NamedOptions{{"flatness", ""}}));
  d.input_format = "poly";
  d.choices = {{"refine", baselines::ChoiceCondition::interior_points, "a{max_volume}", ""},
               {"quality", baselines::ChoiceCondition::improvement, "q", ""}};
  EXPECT_EQ(uses(d), NamedOptions()) << "choices that nothing uses";
  d.command.push_back("-p{refine}");
  EXPECT_EQ(uses(d), (NamedOptions{{"edge-length", "inside"}, {"lattice", "none"}}));
  d.files = {{"how.txt", "{quality}"}};
  EXPECT_EQ(uses(d), (NamedOptions{{"edge-length", "inside"}, {"improve", "none"}, {"lattice", "none"}}));
  d.environment = {{"H", "{edge_length}"}};
  EXPECT_EQ(uses(d), (NamedOptions{{"edge-length", ""}, {"improve", "none"}, {"lattice", "none"}}));
}

TEST(EffectiveOptions, OfTheExamplesOfDescriptions) {
  const Mesher& tetgen = baselines::mesher(std::string(DESCRIBED_FOLDER) + "/tetgen-program.json");
  EXPECT_EQ(effective_options(tetgen, {{"lattice", "sc"}, {"improve", "none"}, {"locator", "grid"}}), NamedOptions());
  EXPECT_EQ(effective_options(tetgen, {{"lattice", "none"}, {"edge-length", "4"}}),
            (NamedOptions{{"lattice", "none"}}));
  EXPECT_TRUE(tetgen.keeps_surface);
  EXPECT_EQ(tetgen.description.filename(), "tetgen-program.json");
}

}  // namespace
}  // namespace ccdt
