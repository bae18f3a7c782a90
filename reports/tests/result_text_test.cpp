#include "reports/result_text.h"

#include <gtest/gtest.h>

namespace ccdt {
namespace {

results::ResultTable example_table() {
  results::ResultTable table{"times",
                             "Seconds & more",
                             {{"model", "model", results::ColumnKind::label},
                              {"count", "tetrahedra"},
                              {"seconds", "seconds", results::ColumnKind::time, "s"},
                              {"reason", "reason", results::ColumnKind::note}}};
  table.rows = {{{std::string("piston"), 1234567.0, bench::Estimate{1.5, 1.25, 1.75}, {}}, {}},
                {{std::string("a, \"b\" 50%"), 0.1, {}, {}}, {}}};
  return table;
}

TEST(ResultText, LeavesOutEmptyColumnsAndRoundsForPeople) {
  const reports::TextTable text = reports::text_table(example_table());
  ASSERT_EQ(text.size(), 3u);
  EXPECT_EQ(text[0], (std::vector<std::string>{"model", "tetrahedra", "seconds (s)"}));
  EXPECT_EQ(text[1], (std::vector<std::string>{"piston", "1,234,567", "1.50 [1.25, 1.75]"}));
  EXPECT_EQ(text[2], (std::vector<std::string>{"a, \"b\" 50%", "0.1000", ""}));
}

TEST(ResultText, GivesAllDigitsAndIntervalsAsCsv) {
  EXPECT_EQ(reports::to_csv(example_table()),
            "model,count,seconds,seconds_low,seconds_high,reason\r\n"
            "piston,1234567,1.5,1.25,1.75,\r\n"
            "\"a, \"\"b\"\" 50%\",0.1,,,,\r\n");
}

TEST(ResultText, EscapesWhatLatexWouldTakeForItsOwn) {
  const std::string text = reports::to_latex(example_table(), "table1");
  EXPECT_NE(text.find("\\caption{Seconds \\& more}"), std::string::npos) << text;
  EXPECT_NE(text.find("a, \"b\" 50\\%"), std::string::npos) << text;
  EXPECT_NE(text.find("\\begin{tabular}{lrr}"), std::string::npos) << text;
  EXPECT_NE(text.find("\\toprule"), std::string::npos) << text;
  EXPECT_NE(text.find("\\bottomrule"), std::string::npos) << text;
}

TEST(ResultText, ShowsFindingsProblemsAndDefinitions) {
  results::ExperimentResult result{.name = "table1", .title = "Table 1"};
  result.tables = {example_table()};
  result.findings = {"a finding"};
  result.problems = {"a problem"};
  result.definitions = {"a definition"};
  for (const std::string& text : {reports::to_terminal(result), reports::to_markdown(result)})
    for (const char* part : {"Table 1", "piston", "a finding", "a problem"})
      EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_NE(reports::to_markdown(result).find("- a definition"), std::string::npos);
}

}  // namespace
}  // namespace ccdt
