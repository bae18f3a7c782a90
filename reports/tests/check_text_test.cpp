#include "reports/check_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace ccdt {
namespace {

using repair::FaultKind;

repair::Diagnosis example_diagnosis() {
  const Place hole{.points = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
      crossing{.points = {{0.5, 0.25, 0}}, .facets = {3, 12}};
  repair::Diagnosis diagnosis{.vertices = 8, .facets = 11};
  diagnosis.faults = {
      {.kind = FaultKind::open_edges, .is_error = true, .count = 1, .detail = "3 edges", .places = {hole}},
      {.kind = FaultKind::crossing_facets,
       .is_error = true,
       .count = 1200,
       .at_least = true,
       .places = {crossing, hole}},
      {.kind = FaultKind::warped_facets, .count = 2}};
  return diagnosis;
}

TEST(CheckText, HasALineForEachFaultAndForItsFirstPlaces) {
  const auto lines = [](std::size_t most_places) {
    const std::string text = reports::to_terminal(example_diagnosis(), most_places);
    return std::ranges::count(text, '\n');
  };
  EXPECT_EQ(lines(0), 3);
  EXPECT_EQ(lines(1), 5);
  EXPECT_EQ(lines(1000), 6);
}

TEST(CheckText, NamesFacetsAndCoordinates) {
  const std::string text = reports::to_terminal(example_diagnosis(), 1);
  for (const char* data : {"1,200", "3 edges", "3, 12", "(0.5, 0.25, 0)", "(1, 0, 1)"})
    EXPECT_NE(text.find(data), std::string::npos) << text;
}

TEST(CheckText, SaysWhatAValidInputEncloses) {
  const std::string words = reports::in_few_words({.vertices = 8, .facets = 12, .regions = 1, .volume = 0.5});
  EXPECT_NE(words.find("12"), std::string::npos) << words;
  EXPECT_NE(words.find("0.5"), std::string::npos) << words;
  EXPECT_NE(reports::in_few_words(example_diagnosis()), words);
}

TEST(CheckText, InJsonListsFaultsAndWhatWasDone) {
  reports::CheckReport report{.input = "a.stl", .diagnosis = example_diagnosis()};
  const auto json = [&] { return nlohmann::json::parse(reports::to_json(report)); };
  EXPECT_EQ(json()["schema"], "ccdt.check/1");
  EXPECT_EQ(json()["valid"], false);
  EXPECT_EQ(json()["faults"][1]["kind"], "crossing-facets");
  EXPECT_EQ(json()["faults"][1]["places"][0]["facets"], nlohmann::json({3, 12}));
  EXPECT_TRUE(json()["copy"].is_null());
  report.copy = {.output = "b.off", .steps = {{"filled_holes", "holes filled", 1}}, .refused = {"a wide hole"}};
  EXPECT_EQ(json()["copy"]["output"], "b.off");
  EXPECT_EQ(json()["copy"]["valid"], true);
  EXPECT_EQ(json()["copy"]["steps"][0]["count"], 1);
  EXPECT_EQ(json()["copy"]["refused"], nlohmann::json({"a wide hole"}));
  EXPECT_TRUE(json()["copy"]["certificate"]["genus"].is_null());
}

}  // namespace
}  // namespace ccdt
