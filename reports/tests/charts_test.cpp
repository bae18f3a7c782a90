#include "reports/charts.h"

#include <gtest/gtest.h>

namespace ccdt {
namespace {

/// Times of two meshers on two sizes, in which both matter.
results::ExperimentResult times_by_size() {
  results::ResultTable table{"cases",
                             "Cases",
                             {{"edge_length", "edge length", results::ColumnKind::figure, "mm"},
                              {"mesher", "mesher", results::ColumnKind::label},
                              {"seconds", "seconds", results::ColumnKind::time, "s"}}};
  for (const double length : {1.0, 2.0})
    for (const double slowness : {3.0, 5.0})
      table.rows.push_back({{length, std::string(slowness > 4 ? "slow" : "fast"), slowness / length}});
  return {.name = "sweep", .tables = {table}};
}

TEST(Charts, OfTwoLabelsNameTheirUnits) {
  reports::ReportChart chart{"sweep", "map", "{first title}, {second title}", "", {"cases"}, "{}"};
  chart.map_of = "seconds";
  const auto made = reports::charts_for(times_by_size(), std::vector{chart});
  ASSERT_EQ(made.size(), 1U);
  EXPECT_EQ(made[0].title, "edge length (mm), mesher");
}

}  // namespace
}  // namespace ccdt
