#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "bench/gate/compare.h"

namespace ccdt::gate {
namespace {

/// A recording of one case with these counts.
Recording recording_of(const std::vector<std::pair<std::string, double>>& counts) {
  Recording recording;
  CaseFigures& one = case_named("part", recording);
  for (const auto& [name, count] : counts) one.figures.push_back({name, Layer::exact, {count}});
  return recording;
}

std::vector<Judgment> judgments_of(const Recording& base, const Recording& head) {
  std::vector<Judgment> all;
  for (const JudgedFigure& figure : compare_exact(base, head, {})) all.push_back(figure.verdict);
  return all;
}

// Reports leave out counts of work that are 0.
TEST(CompareExactTest, WorkThatIsNotInAReportIsZero) {
  const Recording without = recording_of({{"work.front.faces_tested", 5}});
  const Recording with = recording_of({{"work.front.faces_tested", 5}, {"work.front.exact_evaluations", 1}});
  EXPECT_EQ(judgments_of(without, with), (std::vector{Judgment::passed, Judgment::worse}));
  EXPECT_EQ(judgments_of(with, without), (std::vector{Judgment::passed, Judgment::passed}));
}

TEST(CompareExactTest, WorkIsNotComparedWithABaseThatDidNotCountIt) {
  const Recording old = recording_of({{"counts.faces", 5}});
  const Recording now = recording_of({{"counts.faces", 5}, {"work.front.faces_tested", 1}});
  EXPECT_EQ(judgments_of(old, now), (std::vector{Judgment::passed, Judgment::passed}));
  EXPECT_EQ(judgments_of(now, old), (std::vector{Judgment::passed, Judgment::worse}));
}

}  // namespace
}  // namespace ccdt::gate
