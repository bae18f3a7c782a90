#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "bench/experiments/quality_experiments.h"

namespace ccdt {
namespace {

using experiments::QualityRow;
using results::ExperimentResult;
using results::ResultTable;

/// Does one of the lines contain this name or number?
bool say(const std::vector<std::string>& lines, const std::string& data) {
  return std::ranges::any_of(lines, [&](const std::string& line) { return line.find(data) != std::string::npos; });
}

/// The row of a variant of a plan, as if it had been measured.
QualityRow row(const experiments::StudyPlan& plan, const std::string& variant, double mean_r, double worst_r,
               double dihedral, const std::string& model = "part.off") {
  const auto& found = *std::ranges::find(plan.variants, variant, &experiments::QualityVariant::name);
  QualityRow made{{}, model, found.labels, 0.5, 10000};
  made.measured.asked.name = model + ", " + variant;
  made.measured.asked.mesher = found.mesher;
  bench::RunRecord run;
  run.counts.tetrahedra = 10000;
  run.quality.r = {1, mean_r, mean_r, 0.5 * (mean_r + worst_r), worst_r, {{1, 1.1, 1.2, 1000}, {9000, 999, 1}}};
  run.quality.dihedral_degrees = {dihedral, 180 - dihedral, {{0, 5, 10, 180}, {0, 6, 59994}}};
  bench::add_run(made.measured, run);
  return made;
}

void fail(QualityRow& row) {
  row.measured.first.set_failure(baselines::FailureKind::crashed, "ended by signal SIGSEGV");
}

/// The values of a column.
std::vector<double> numbers(const ExperimentResult& result, const char* table_name, const char* column) {
  std::vector<double> all;
  const ResultTable& table = *results::find_table(result, table_name);
  for (const results::ResultRow& row : table.rows) all.push_back(results::number_in(table, row, column));
  return all;
}

std::vector<std::string> texts(const ExperimentResult& result, const char* table_name, const char* column) {
  std::vector<std::string> all;
  const ResultTable& table = *results::find_table(result, table_name);
  for (const results::ResultRow& row : table.rows) all.push_back(results::text_in(table, row, column));
  return all;
}

using Texts = std::vector<std::string>;

/// Our meshes and two others, which stand for meshers that this build may lack.
class MesherQuality : public testing::Test {
 protected:
  MesherQuality() {
    for (const char* name : {"tetgen", "gmsh-hxt"}) {
      std::erase_if(plan_.variants, [&](const auto& variant) { return variant.name == name; });
      plan_.variants.push_back({name, name, {}, {name, name}});
    }
    rows_ = {row(plan_, "ccdt fcc", 1.2, 3, 17), row(plan_, "ccdt bcc", 1.1, 2, 30), row(plan_, "tetgen", 1.5, 8, 10),
             row(plan_, "gmsh-hxt", 1.4, 4, 18)};
  }

  ExperimentResult result() const { return experiments::study_result(plan_, rows_, {}); }

  experiments::StudyPlan plan_ = experiments::mesher_quality_plan({}, "quality", {});
  std::vector<QualityRow> rows_;
};

TEST_F(MesherQuality, IsComparedWithTheBestOfTheOthersByEachCriterion) {
  EXPECT_EQ(texts(result(), "verdicts", "criterion"), (Texts{"mean r", "p99 r", "worst r", "smallest dihedral",
                                                             "mean r", "p99 r", "worst r", "smallest dihedral"}));
  // HXT has the larger smallest angle than our FCC.
  EXPECT_EQ(texts(result(), "verdicts", "better"), (Texts{"yes", "yes", "yes", "no", "yes", "yes", "yes", "yes"}));
  EXPECT_EQ(texts(result(), "verdicts", "best_other_variant"), Texts(8, "gmsh-hxt"));
  EXPECT_EQ(numbers(result(), "verdicts", "best_other")[0], 1.4);
  EXPECT_TRUE(say(result().findings, "ccdt fcc"));
}

TEST_F(MesherQuality, IsNotComparedWithOtherCountsOrFailures) {
  rows_[2].reference = 20000;
  fail(rows_[3]);
  EXPECT_EQ(texts(result(), "verdicts", "better"), Texts(8));
  EXPECT_EQ(texts(result(), "verdicts", "best_other_variant"), Texts(8));
  EXPECT_TRUE(result().is_good);
  EXPECT_TRUE(say(result().problems, "SIGSEGV"));
  EXPECT_TRUE(say(result().problems, "tetgen"));
  fail(rows_[0]);
  EXPECT_EQ(numbers(result(), "verdicts", "ours").size(), 4u);
  EXPECT_FALSE(result().is_good);
}

TEST_F(MesherQuality, HasFiguresOfWhatWentWellAndHistogramsInPercent) {
  fail(rows_[3]);
  EXPECT_EQ(texts(result(), "quality", "status"), (Texts{"ok", "ok", "ok", "crashed"}));
  EXPECT_EQ(numbers(result(), "quality", "largest_dihedral")[1], 150);
  EXPECT_TRUE(std::isnan(numbers(result(), "quality", "mean_r")[3]));
  const auto percent = numbers(result(), "r_histogram", "percent");
  ASSERT_EQ(percent.size(), 9u);
  EXPECT_EQ(percent[0], 90);
  EXPECT_EQ(numbers(result(), "r_histogram", "high")[0], 1.1);
}

/// Rows of the three lattices. Inside, FCC is better than it is in whole meshes.
std::vector<QualityRow> lattice_rows(const std::string& model, double fcc, double bcc, double sc) {
  const experiments::StudyPlan plan = experiments::lattices_plan();
  std::vector<QualityRow> rows;
  for (const std::string suffix : {"", " improved"}) {
    rows.push_back(row(plan, "fcc" + suffix, fcc, 2 * fcc, 20, model));
    rows.push_back(row(plan, "bcc" + suffix, bcc, 2 * bcc, 20, model));
    rows.push_back(row(plan, "sc" + suffix, sc, 2 * sc, 10, model));
  }
  for (std::size_t i = 0; i < 3; ++i) rows[i].inside = {100, rows[i].measured.first.quality};
  rows[0].inside->quality.r.mean = 1.01;
  return rows;
}

TEST(Lattices, ConfirmTheClaimOnlyIfFccAloneIsBestInEveryCase) {
  std::vector<QualityRow> rows = lattice_rows("a", 1.1, 1.2, 1.3);
  std::ranges::copy(lattice_rows("b", 1.15, 1.2, 1.5), std::back_inserter(rows));
  ExperimentResult result = experiments::study_result(experiments::lattices_plan(), rows, {});
  EXPECT_EQ(texts(result, "best", "meshes")[4], "inside");
  EXPECT_EQ(texts(result, "best", "meshes")[5], "whole");
  EXPECT_EQ(texts(result, "best", "meshes")[10], "improved");
  // By the smallest dihedral angle there is a tie with BCC, by the largest as well.
  const Texts expected = {"yes", "yes", "yes", "no", "no"};
  for (std::size_t i = 0; i < 15; ++i) EXPECT_EQ(texts(result, "best", "confirmed")[i], expected[i % 5]) << i;
  EXPECT_EQ(numbers(result, "best", "bcc")[3], 2);
  EXPECT_TRUE(say(result.findings, "mean r, p99 r, worst r"));
  EXPECT_TRUE(say(result.findings, "smallest dihedral, largest dihedral"));
  std::ranges::copy(lattice_rows("c", 1.2, 1.1, 1.3), std::back_inserter(rows));
  result = experiments::study_result(experiments::lattices_plan(), rows, {});
  EXPECT_EQ(texts(result, "best", "confirmed")[0], "yes");  // inside, by the mean
  for (std::size_t i = 1; i < 15; ++i) EXPECT_EQ(texts(result, "best", "confirmed")[i], "no") << i;
  EXPECT_EQ(numbers(result, "best", "fcc")[5], 2);
  EXPECT_EQ(numbers(result, "best", "bcc")[5], 1);
}

TEST(Lattices, LeaveOutCasesInWhichOneFailedOrHasNothingInside) {
  std::vector<QualityRow> rows = lattice_rows("a", 1.1, 1.2, 1.3);
  fail(rows[5]);  // improved
  rows[1].inside = experiments::InsideQuality{};
  const ExperimentResult result = experiments::study_result(experiments::lattices_plan(), rows, {});
  EXPECT_EQ(numbers(result, "best", "cases"), (std::vector<double>{0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0}));
}

TEST(Lattices, HaveATableOfMeshesInsideWholeAndImproved) {
  const ExperimentResult result =
      experiments::study_result(experiments::lattices_plan(), lattice_rows("a", 1.1, 1.2, 1.3), {});
  for (const char* table : {"inside", "whole", "improved"})
    EXPECT_EQ(texts(result, table, "lattice"), (Texts{"fcc", "bcc", "sc"})) << table;
  EXPECT_EQ(numbers(result, "inside", "mean_r"), (std::vector<double>{1.01, 1.2, 1.3}));
  EXPECT_EQ(numbers(result, "inside", "tetrahedra"), (std::vector<double>{100, 100, 100}));
  EXPECT_EQ(numbers(result, "whole", "mean_r"), (std::vector<double>{1.1, 1.2, 1.3}));
  EXPECT_EQ(numbers(result, "quality", "mean_r").size(), 6u);  // for charts
}

TEST(Lattices, BeginWithTheUnitCells) {
  const ExperimentResult result = experiments::study_result(experiments::lattices_plan(), {}, {});
  EXPECT_EQ(result.tables[0].name, "unit_cells");
  EXPECT_EQ(texts(result, "unit_cells", "lattice").size(), 14u);
  EXPECT_EQ(texts(result, "unit_cells", "worst_squared_r")[2], "343/216");
  EXPECT_EQ(texts(result, "unit_cells", "parameters")[9], "(c/a)^2 = 5/8");
  EXPECT_EQ(texts(result, "unit_cells", "similar_to")[13], "body-centered cubic");
  // Only regular tetrahedra speak for FCC: a third of its own, a fifth of the cube's in five, none of BCC's.
  const Texts by = texts(result, "unit_cell_criteria", "criterion");
  const Texts confirmed = texts(result, "unit_cell_criteria", "confirmed");
  for (std::size_t i = 0; i < by.size(); ++i)
    EXPECT_EQ(confirmed[i], by[i] == "share of regular tetrahedra" ? "yes" : "no") << by[i];
  EXPECT_EQ(by[1], "worst r");
  EXPECT_EQ(texts(result, "unit_cell_criteria", "best_other_lattices")[1], "body-centered cubic");
  EXPECT_NEAR(numbers(result, "unit_cell_criteria", "best_other")[1], std::sqrt(125.0 / 108), 1e-12);
  EXPECT_EQ(texts(result, "unit_cell_criteria", "best_other_lattices")[3], "simple cubic");  // as good as FCC
}

TEST(Improvement, CountsInHowManyCasesEachPartIsBest) {
  const experiments::StudyPlan plan = experiments::improvement_plan();
  const std::vector<QualityRow> rows = {row(plan, "none", 1.3, 50, 1), row(plan, "swap", 1.2, 9, 5),
                                        row(plan, "all", 1.2, 3, 18)};
  EXPECT_EQ(numbers(experiments::study_result(plan, rows, {}), "best", "best"),
            (std::vector<double>{0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
}

class LatticeFit : public testing::Test {
 protected:
  /// On each of two models one setting is better than the others, which are equal.
  std::vector<QualityRow> rows_with(const std::string& best) const {
    std::vector<QualityRow> rows;
    for (const char* model : {"a", "b"})
      for (const auto& variant : plan_.variants)
        rows.push_back(variant.name == best ? row(plan_, variant.name, 1.2, 2, 20, model)
                                            : row(plan_, variant.name, 1.2, 8, 10, model));
    return rows;
  }
  ExperimentResult result_of(const std::vector<QualityRow>& rows) const {
    return experiments::study_result(plan_, rows, {});
  }

  const experiments::StudyPlan plan_ = experiments::lattice_fit_plan();
  const std::string default_ = "sphere 1, clearance 0.55";
};

TEST_F(LatticeFit, RanksSettingsOverAllModels) {
  std::vector<QualityRow> rows = rows_with(plan_.variants[3].name);
  ExperimentResult result = result_of(rows);
  const double n = static_cast<double>(plan_.variants.size());
  ASSERT_EQ(numbers(result, "settings", "rank").size(), plan_.variants.size());
  // Best alone in p99, worst r and the angle, tied with all in mean r.
  EXPECT_NEAR(numbers(result, "settings", "rank")[3], (3 + (n + 1) / 2) / 4, 1e-12);
  EXPECT_NEAR(numbers(result, "settings", "rank")[0], (3 * (n + 2) / 2 + (n + 1) / 2) / 4, 1e-12);
  EXPECT_NEAR(numbers(result, "settings", "worst_r")[3], 2, 1e-12);
  fail(rows[0]);  // so that only the second model counts
  rows[plan_.variants.size()].measured.first.quality.r.max = 32;
  EXPECT_NEAR(numbers(result_of(rows), "settings", "worst_r")[0], 32, 1e-12);
  fail(rows.back());
  EXPECT_TRUE(numbers(result_of(rows), "settings", "rank").empty());
}

TEST_F(LatticeFit, NamesTheBestSettingAndWhetherItIsTheDefault) {
  EXPECT_EQ(std::ranges::count(plan_.variants, default_, &experiments::QualityVariant::name), 1);
  const std::string other = plan_.variants.front().name;
  const auto if_default = result_of(rows_with(default_)).findings, if_other = result_of(rows_with(other)).findings;
  EXPECT_TRUE(say(if_default, default_));
  EXPECT_FALSE(say(if_default, other));
  EXPECT_TRUE(say(if_other, other));
  EXPECT_TRUE(say(if_other, default_));
}

}  // namespace
}  // namespace ccdt
