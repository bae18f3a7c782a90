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

TEST(TextTable, MarkdownShowsTextsAsTheyAre) {
  const std::string strange = "a`<img src=x onerror=alert(1)>`[b](javascript:c) & *d*";
  const std::string plain = reports::to_markdown(reports::TextTable{{"name"}, {strange}});
  EXPECT_NE(plain.find("a\\`&lt;img src=x onerror=alert(1)>\\`\\[b\\](javascript:c) &amp; \\*d\\*"), std::string::npos);
  const std::string code = reports::to_markdown(reports::TextTable{{"name"}, {strange}}, {0});
  EXPECT_NE(code.find("`` " + strange + " ``"), std::string::npos) << "a fence that the text cannot close";
  EXPECT_EQ(reports::markdown_code("plain"), "`plain`");
  EXPECT_EQ(reports::markdown_code("a``b`"), "``` a``b` ```");
}

TEST(TextTable, BarsWithinMarkdownCellsAreEscaped) {
  EXPECT_NE(reports::to_markdown(reports::TextTable{{"a|b"}}).find("a\\|b"), std::string::npos);
}

}  // namespace
}  // namespace ccdt
