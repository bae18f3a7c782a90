#include "bench/results/experiment_result.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "bench/results/kept_mesh.h"
#include "engine/base/errors.h"

namespace ccdt {
namespace {

results::ExperimentResult example_result() {
  results::ExperimentResult result{.name = "fig8", .title = "Fig. 8", .section = "6"};
  result.how.runs = 5;
  result.how.tetrahedra = 10000;
  result.how.scale = "quick";
  result.how.command = "ccdt reproduce fig8 -o .";
  result.findings = {"a finding"};
  result.meshes = {{"meshes/a.json", "a", "runs/a-1.json", true}};
  result.is_good = false;
  results::ResultTable table{"points",
                             "Points",
                             {{"model", "model", results::ColumnKind::label},
                              {"count", "count"},
                              {"seconds", "seconds", results::ColumnKind::time, "s"},
                              {"reason", "reason", results::ColumnKind::note}}};
  table.rows = {
      {{std::string("piston"), 1234567.0, bench::Estimate{1.5, 1.25, 1.75}, {}}, {"runs/a-1.json", "runs/a-2.json"}},
      {{std::string("bracket"), 0.1, {}, std::string("crashed")}, {}}};
  result.tables = {table};
  return result;
}

TEST(ExperimentResult, ReadsBackFromItsJson) {
  const std::string text = results::to_json(example_result());
  EXPECT_EQ(results::to_json(results::experiment_result_from_json(text)), text);
  const results::ExperimentResult read = results::experiment_result_from_json(text);
  const results::ResultTable& table = *results::find_table(read, "points");
  EXPECT_EQ(results::text_in(table, table.rows[0], "model"), "piston");
  EXPECT_EQ(results::number_in(table, table.rows[1], "count"), 0.1);
  EXPECT_EQ(results::number_in(table, table.rows[0], "seconds"), 1.5);
  EXPECT_TRUE(std::isnan(results::number_in(table, table.rows[1], "seconds")));
  EXPECT_EQ(table.rows[0].runs.size(), 2u);
  EXPECT_EQ(table.columns[2].kind, results::ColumnKind::time);
  EXPECT_EQ(read.how.scale, "quick");
  EXPECT_FALSE(read.is_good);
  EXPECT_EQ(results::find_table(read, "lines"), nullptr);
}

TEST(ExperimentResult, WritesWholeNumbersAsSuchAndInfiniteOnesAsNull) {
  results::ExperimentResult result = example_result();
  result.tables[0].rows[1].cells[1] = std::numeric_limits<double>::infinity();
  const auto json = nlohmann::json::parse(results::to_json(result));
  EXPECT_EQ(json["tables"][0]["rows"][0]["values"]["count"].dump(), "1234567");
  EXPECT_TRUE(json["tables"][0]["rows"][1]["values"]["count"].is_null());
}

TEST(ExperimentResult, WritesAndReadsAnEstimateWithoutAnInterval) {
  results::ExperimentResult result = example_result();
  result.tables[0].rows[0].cells[2] = bench::without_interval(1.5);
  const std::string text = results::to_json(result);
  const auto seconds = nlohmann::json::parse(text)["tables"][0]["rows"][0]["values"]["seconds"];
  EXPECT_EQ(seconds["value"], 1.5);
  EXPECT_TRUE(seconds["low"].is_null() && seconds["high"].is_null());
  const results::ExperimentResult read = results::experiment_result_from_json(text);
  EXPECT_EQ(read.tables[0].rows[0].cells[2], results::Cell(bench::without_interval(1.5)));
}

TEST(ExperimentResult, RefusesOtherJson) {
  EXPECT_THROW(results::experiment_result_from_json("{"), InputError);
  EXPECT_THROW(results::experiment_result_from_json("[]"), InputError);
  EXPECT_THROW(results::experiment_result_from_json(R"({"schema": "ccdt.run/1"})"), InputError);
  EXPECT_THROW(results::experiment_result_from_json(R"({"schema": "ccdt.experiment/1"})"), InputError);
}

TEST(ResultTable, DoesNotGuessColumns) {
  const results::ExperimentResult result = example_result();
  EXPECT_THROW(results::column_of(result.tables[0], "second"), std::out_of_range);
}

TEST(KeptMesh, PacksBytesAsZlibInBase64) {
  EXPECT_EQ(results::packed("", 0), "eNoDAAAAAAE=");
}

}  // namespace
}  // namespace ccdt
