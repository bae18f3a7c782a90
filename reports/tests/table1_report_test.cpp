#include "reports/table1_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reports/table1_differences.h"

namespace ccdt {
namespace {

Table1 example() {
  Table1 table;
  table.how.runs = 5;
  table.how.environment.cpu = "a cpu";
  Table1Model model;
  model.name = "piston";
  model.edge_length = 2;
  model.rows.push_back({"delaunay",
                        "Delaunay",
                        {1, 1, 1, 1, 1},
                        Estimate{1, 1, 1},
                        25.53,
                        {100, 2, 30, 400, 50, 6, 7, {}, 0},
                        RunStatus::ok,
                        ""});
  model.rows.push_back({"tetgen_cdt", "TetGen CDT", {}, {}, {}, {}, RunStatus::crashed, "ended by signal SIGSEGV"});
  model.ratios.push_back({"with_check/delaunay", "with check / Delaunay", Estimate{1.02, 1.01, 1.03}, 1.0188});
  table.models.push_back(model);
  return table;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Table1Report, ShowsThePapersFiguresBesideOurs) {
  for (const std::string& text : {to_terminal(example()), to_markdown(example())}) {
    EXPECT_TRUE(contains(text, "25.53")) << text;
    EXPECT_TRUE(contains(text, "1.019")) << text;
    EXPECT_TRUE(contains(text, "1.020 [1.010, 1.030]")) << text;
  }
}

TEST(Table1Report, GivesAFailedRowItsReason) {
  for (const std::string& text : {to_terminal(example()), to_markdown(example())})
    EXPECT_TRUE(contains(text, "piston, TetGen CDT: crashed: ended by signal SIGSEGV")) << text;
}

TEST(Table1Report, ComplainsWhenTheCheckChangesTheTetrahedra) {
  Table1 table = example();
  EXPECT_FALSE(contains(to_terminal(table), "the tetrahedra differ"));
  table.models[0].same_tetrahedra = false;
  EXPECT_TRUE(contains(to_terminal(table), "the tetrahedra differ"));
}

/// A table with these two ratios.
Table1 with_ratios(const Estimate& check, const Estimate& front) {
  Table1 table = example();
  table.models[0].ratios = {{"with_check/delaunay", "", check, 1.0188}, {"without_check/delaunay", "", front, 23.59}};
  table.models[0].costs = Table1Costs{3.25, 0.5, 7.5};
  return table;
}

TEST(Table1Differences, GiveReasonsOnlyWhereThePaperIsNotReached) {
  const auto alike = table1_differences(with_ratios({1.01, 1.0, 1.015}, {25, 24, 26}));
  ASSERT_EQ(alike.size(), 2u);
  EXPECT_TRUE(contains(alike[0], "(paper: 1.019): not more than there.")) << alike[0];
  EXPECT_TRUE(contains(alike[1], "(paper: 23.59): at least 8.")) << alike[1];

  const auto different = table1_differences(with_ratios({1.2, 1.1, 1.3}, {7, 6.5, 7.5}));
  ASSERT_EQ(different.size(), 4u);
  EXPECT_TRUE(contains(different[0], "more than there.")) << different[0];
  EXPECT_TRUE(contains(different[1], "0.500 microseconds a vertex")) << different[1];
  EXPECT_TRUE(contains(different[1], "3.25 microseconds a vertex")) << different[1];
  EXPECT_TRUE(contains(different[2], "less than 8.")) << different[2];
  EXPECT_TRUE(contains(different[3], "7.50 microseconds a tetrahedron")) << different[3];
}

TEST(Table1Differences, AreNotClaimedWhereTheIntervalDoesNotTell) {
  const auto lines = table1_differences(with_ratios({1.02, 1.01, 1.03}, {8.5, 7.5, 9.5}));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_TRUE(contains(lines[0], "cannot tell")) << lines[0];
  EXPECT_TRUE(contains(lines[2], "not surely 8.")) << lines[2];
}

TEST(Table1Report, HasTheDifferencesInBothForms) {
  const Table1 table = with_ratios({1.2, 1.1, 1.3}, {7, 6.5, 7.5});
  for (const std::string& text : {to_terminal(table), to_markdown(table)}) {
    EXPECT_TRUE(contains(text, "Where this differs from the paper, and why")) << text;
    EXPECT_TRUE(contains(text, "7.50 microseconds a tetrahedron")) << text;
  }
}

TEST(Table1Json, KeepsSamplesAndReasons) {
  const auto json = nlohmann::json::parse(to_json(example()));
  EXPECT_EQ(json["schema"], "ccdt.table1/1");
  EXPECT_EQ(json["models"][0]["rows"][0]["samples"].size(), 5u);
  EXPECT_EQ(json["models"][0]["rows"][0]["paper_seconds"], 25.53);
  EXPECT_TRUE(json["models"][0]["rows"][1]["seconds"].is_null());
  EXPECT_EQ(json["models"][0]["rows"][1]["status"], "crashed");
  EXPECT_EQ(json["models"][0]["ratios"][0]["ratio"]["median"], 1.02);
}

}  // namespace
}  // namespace ccdt
