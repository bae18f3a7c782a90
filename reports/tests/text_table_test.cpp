#include "reports/text_table.h"

#include <gtest/gtest.h>

namespace ccdt {
namespace {

TEST(TextTable, AlignsColumnsForATerminal) {
  EXPECT_EQ(to_terminal({{"name", "s"}, {"a", "10"}, {"long name", "5"}}),
            "name        s\n"
            "---------  --\n"
            "a          10\n"
            "long name   5\n");
}

TEST(TextTable, CountsCharactersAndNotBytes) {
  EXPECT_EQ(to_terminal({{"é", "x"}, {"ab", "y"}}), "é   x\n--  -\nab  y\n");
}

TEST(TextTable, MarkdownHasARuleAndFillsShortRows) {
  EXPECT_EQ(to_markdown({{"name", "seconds"}, {"a"}}),
            "| name | seconds |\n"
            "|------|--------:|\n"
            "| a    |         |\n");
}

TEST(TextTable, BarsWithinMarkdownCellsAreEscaped) {
  EXPECT_NE(to_markdown({{"a|b"}}).find("a\\|b"), std::string::npos);
}

}  // namespace
}  // namespace ccdt
