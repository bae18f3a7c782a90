#include "bench/results/experiment_result.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "bench/experiments/timing_experiments.h"
#include "bench/results/kept_mesh.h"
#include "engine/base/errors.h"

namespace ccdt {
namespace {

results::ExperimentResult example() {
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
  const std::string text = results::to_json(example());
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
  results::ExperimentResult result = example();
  result.tables[0].rows[1].cells[1] = std::numeric_limits<double>::infinity();
  const auto json = nlohmann::json::parse(results::to_json(result));
  EXPECT_EQ(json["tables"][0]["rows"][0]["values"]["count"].dump(), "1234567");
  EXPECT_TRUE(json["tables"][0]["rows"][1]["values"]["count"].is_null());
}

TEST(ExperimentResult, RefusesOtherJson) {
  EXPECT_THROW(results::experiment_result_from_json("{"), InputError);
  EXPECT_THROW(results::experiment_result_from_json("[]"), InputError);
  EXPECT_THROW(results::experiment_result_from_json(R"({"schema": "ccdt.run/1"})"), InputError);
  EXPECT_THROW(results::experiment_result_from_json(R"({"schema": "ccdt.experiment/1"})"), InputError);
}

TEST(ResultTable, DoesNotGuessColumns) {
  const results::ExperimentResult result = example();
  EXPECT_THROW(results::column_of(result.tables[0], "second"), std::out_of_range);
}

TEST(KeptMesh, PacksBytesAsZlibInBase64) {
  EXPECT_EQ(results::packed("", 0), "eNoDAAAAAAE=");
}

experiments::Table1 table_with_ratios(const bench::Estimate& check, const bench::Estimate& front) {
  experiments::Table1 table;
  experiments::Table1Model model;
  model.name = "piston";
  model.rows.push_back({{.runs = {"runs/a.json"}, .samples = {1, 1}, .seconds = bench::Estimate{1, 1, 1}},
                        "delaunay",
                        "Delaunay",
                        25.53});
  model.rows.push_back({{baselines::RunStatus::crashed, "ended by signal SIGSEGV"}, "tetgen_cdt", "TetGen CDT"});
  model.ratios = {{"with_check/delaunay", "with check / Delaunay", check, 1.0188},
                  {"without_check/delaunay", "without check / Delaunay", front, 23.59}};
  model.costs = experiments::Table1Costs{3.25, 0.5, 7.5};
  table.models.push_back(model);
  return table;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Table1Result, GivesReasonsOnlyWhereThePaperIsNotReached) {
  const auto alike = experiments::result_of(table_with_ratios({1.01, 1.0, 1.015}, {25, 24, 26})).findings;
  ASSERT_EQ(alike.size(), 2u);
  EXPECT_TRUE(contains(alike[0], "(paper: 1.019): not more than there.")) << alike[0];
  EXPECT_TRUE(contains(alike[1], "(paper: 23.59): at least 8.")) << alike[1];

  const auto different = experiments::result_of(table_with_ratios({1.2, 1.1, 1.3}, {7, 6.5, 7.5})).findings;
  ASSERT_EQ(different.size(), 4u);
  EXPECT_TRUE(contains(different[0], "more than there.")) << different[0];
  EXPECT_TRUE(contains(different[1], "0.500 microseconds a vertex")) << different[1];
  EXPECT_TRUE(contains(different[2], "less than 8.")) << different[2];
  EXPECT_TRUE(contains(different[3], "7.50 microseconds a tetrahedron")) << different[3];

  const auto open = experiments::result_of(table_with_ratios({1.02, 1.01, 1.03}, {8.5, 7.9, 9})).findings;
  EXPECT_TRUE(contains(open[0], "these runs cannot tell it from there.")) << open[0];
}

TEST(Table1Result, MakesOfAFailedBaselineARowWithItsReason) {
  const results::ExperimentResult result = experiments::result_of(table_with_ratios({1.02, 1.01, 1.03}, {9, 8, 10}));
  const results::ResultTable& times = *results::find_table(result, "times");
  ASSERT_EQ(times.rows.size(), 2u);
  EXPECT_EQ(results::text_in(times, times.rows[1], "status"), "crashed");
  EXPECT_EQ(results::text_in(times, times.rows[1], "reason"), "ended by signal SIGSEGV");
  EXPECT_EQ(result.problems, std::vector<std::string>{"piston, TetGen CDT: crashed: ended by signal SIGSEGV"});
  EXPECT_TRUE(result.is_good);
}

TEST(Table1Result, IsNotGoodWhenTheCheckChangesTheTetrahedra) {
  experiments::Table1 table = table_with_ratios({1.02, 1.01, 1.03}, {9, 8, 10});
  table.models[0].same_tetrahedra = false;
  EXPECT_FALSE(experiments::result_of(table).is_good);
}

}  // namespace
}  // namespace ccdt
