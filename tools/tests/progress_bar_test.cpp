#include "tools/progress_bar.h"

#include <gtest/gtest.h>

namespace ccdt {
namespace {

TEST(ProgressBar, ShowsStageBarPerCentAndSeconds) {
  EXPECT_EQ(tools::progress_line("delaunay", 1, 2, 7.9, 80), "delaunay [###############...............] 50% 7 s");
}

TEST(ProgressBar, WithoutATotalShowsWhatIsDone) {
  EXPECT_EQ(tools::progress_line("front", 12, 0, 0, 80), "front 12 0 s");
  EXPECT_EQ(tools::progress_line("tetgen", 0, 0, 3, 80), "tetgen 3 s");
}

TEST(ProgressBar, NeverPassesTheEndOfTheLineOrTheBar) {
  EXPECT_EQ(tools::progress_line("delaunay", 3, 2, 1, 12).size(), 11u);
  EXPECT_NE(tools::progress_line("delaunay", 3, 2, 1, 80).find("100%"), std::string::npos);
}

}  // namespace
}  // namespace ccdt
