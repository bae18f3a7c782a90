#include <gtest/gtest.h>

#include "reports/result_text.h"

namespace ccdt {
namespace {

TEST(TextTable, AlignsColumnsForATerminal) {
  EXPECT_EQ(reports::to_terminal(reports::TextTable{{"name", "s"}, {"a", "10"}, {"long name", "5"}}),
            "name        s\n"
            "---------  --\n"
            "a          10\n"
            "long name   5\n");
}

TEST(TextTable, CountsCharactersAndNotBytes) {
  EXPECT_EQ(reports::to_terminal(reports::TextTable{{"é", "x"}, {"ab", "y"}}), "é   x\n--  -\nab  y\n");
}

TEST(TextTable, MarkdownHasARuleAndFillsShortRows) {
  EXPECT_EQ(reports::to_markdown(reports::TextTable{{"name", "seconds"}, {"a"}}),
            "| name | seconds |\n"
            "|------|--------:|\n"
            "| a    |         |\n");
}

TEST(TextTable, BarsWithinMarkdownCellsAreEscaped) {
  EXPECT_NE(reports::to_markdown(reports::TextTable{{"a|b"}}).find("a\\|b"), std::string::npos);
}

}  // namespace
}  // namespace ccdt
