#include <gtest/gtest.h>

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

TEST(VerificationReport, HasALineACheckAndItsExamples) {
  EXPECT_EQ(reports::to_terminal(example(true)),
            "ok       positive orientation  1,200\n"
            "FAILED   faces shared by two   3 of 2,000\n"
            "           face 1 2 3\n"
            "volume   8.00000000000, of the input 8.00000000000\n");
}

TEST(VerificationReport, OfWhatIsNotRequiredDoesNotSayFailed) {
  EXPECT_EQ(reports::to_terminal(example(false)).find("FAILED"), std::string::npos);
}

TEST(VerificationReport, InJsonSaysWhatFailed) {
  const auto json = nlohmann::json::parse(reports::to_json(example(true), "a.off", "a.vtu"));
  EXPECT_EQ(json["schema"], "ccdt.verify/1");
  EXPECT_EQ(json["ok"], false);
  EXPECT_EQ(json["checks"][1]["failed"], 3);
}

}  // namespace
}  // namespace ccdt
