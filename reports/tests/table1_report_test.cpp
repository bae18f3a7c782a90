#include "reports/table1_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace ccdt {
namespace {

Table1 example() {
  Table1 table;
  table.runs = 5;
  table.environment.cpu = "a cpu";
  Table1Model model;
  model.name = "piston";
  model.edge_length = 2;
  model.rows.push_back({"delaunay",
                        "Delaunay",
                        {1, 1, 1, 1, 1},
                        Estimate{1, 1, 1},
                        25.53,
                        {100, 2, 30, 400, 50, 6, 7},
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
  EXPECT_FALSE(contains(to_terminal(table), "differ"));
  table.models[0].same_tetrahedra = false;
  EXPECT_TRUE(contains(to_terminal(table), "the tetrahedra differ"));
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
