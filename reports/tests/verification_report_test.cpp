#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reports/result_text.h"

namespace ccdt {
namespace {

verify::Verification example(bool required) {
  verify::Verification verification;
  verification.checks = {{"positive orientation", 1200, 0, true, {}},
                         {"faces shared by two", 2000, 3, required, {"face 1 2 3"}}};
  verification.mesh_volume = verification.input_volume = 8;
  return verification;
}

TEST(VerificationReport, HasALineForEachCheckAndItsExamples) {
  const std::string text = reports::to_terminal(example(true));
  EXPECT_EQ(std::ranges::count(text, '\n'), 4) << text;
  for (const char* data :
       {"positive orientation  1,200\n", "faces shared by two   3 of 2,000\n", "face 1 2 3\n", "8.00000"})
    EXPECT_NE(text.find(data), std::string::npos) << text;
}

TEST(VerificationReport, TellsRequiredChecksFromOthers) {
  const std::string required = reports::to_terminal(example(true)), other = reports::to_terminal(example(false));
  EXPECT_NE(required, other);
}

TEST(VerificationReport, InShortListsFailedChecksOnly) {
  const std::string text = reports::summarize(example(true));
  EXPECT_EQ(text.find("positive orientation"), std::string::npos) << text;
  EXPECT_NE(text.find("faces shared by two"), std::string::npos) << text;
  EXPECT_NE(text.find("face 1 2 3"), std::string::npos) << text;
}

TEST(VerificationReport, InShortHasTwoLinesForAMeshThatIsRight) {
  const std::string text = reports::summarize(example(false));
  EXPECT_EQ(std::ranges::count(text, '\n'), 2) << text;
}

TEST(VerificationReport, SaysWhatWasNotCompared) {
  verify::Verification verification = example(false);
  verification.checks.push_back({.name = "colors", .not_compared = "the mesh has no colors"});
  for (const std::string& text : {reports::summarize(verification), reports::to_terminal(verification)})
    EXPECT_NE(text.find("the mesh has no colors"), std::string::npos) << text;
  const auto json = nlohmann::json::parse(reports::to_json(verification, "a.off", "a.vtu"));
  EXPECT_EQ(json["checks"][2]["not_compared"], "the mesh has no colors");
  EXPECT_FALSE(json["checks"][0].contains("not_compared"));
}

TEST(VerificationReport, InJsonSaysWhatFailed) {
  const auto json = nlohmann::json::parse(reports::to_json(example(true), "a.off", "a.vtu"));
  EXPECT_EQ(json["schema"], "ccdt.verify/1");
  EXPECT_EQ(json["ok"], false);
  EXPECT_EQ(json["checks"][1]["failed"], 3);
}

}  // namespace
}  // namespace ccdt
