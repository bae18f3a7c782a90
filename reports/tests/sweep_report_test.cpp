#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "bench/results/sweep_result.h"
#include "bench/run/json.h"
#include "engine/io/files.h"
#include "reports/report.h"
#include "reports/tests/made_up_sweep.h"

namespace ccdt {
namespace {

using bench::Json;
using results::ResultTable;

/// A made-up sweep in a folder of its own.
class SweepReport : public testing::Test {
 protected:
  SweepReport() {
    std::string name = testing::TempDir() + "/ccdt-sweep-XXXXXX";
    root_ = mkdtemp(name.data());
    write_made_up_sweep({.failing = 0.2}, folder());
  }
  ~SweepReport() override { std::filesystem::remove_all(root_); }

  std::filesystem::path folder(const std::string& name = "a") const { return root_ / name; }

  reports::Report report() const { return reports::read_report(folder(), {}); }

  /// A record of a case of ccdt, of its number.
  std::filesystem::path record(int number) const {
    const Json sweep = read("sweep.json");
    for (const Json& one : sweep.at("cases"))
      if (one.at("mesher") == "ccdt")
        return "runs/" + one.at("id").get<std::string>() + "-" + std::to_string(number) + ".json";
    return {};
  }

  Json read(const std::filesystem::path& file) const { return Json::parse(io::read_whole_file(folder() / file).bytes); }
  void write(const Json& json, const std::filesystem::path& file) const { bench::write_json(json, folder() / file); }

 private:
  std::filesystem::path root_;
};

const results::ExperimentResult& result_of(const reports::Report& report) {
  return report.sections.at(0).result;
}

const ResultTable& table(const reports::Report& report, const std::string& name) {
  const ResultTable* found = results::find_table(result_of(report), name);
  if (found == nullptr) throw std::out_of_range(name);
  return *found;
}

double sum_of(const ResultTable& table, const std::string& column) {
  double sum = 0;
  for (const auto& row : table.rows) sum += results::number_in(table, row, column);
  return sum;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(SweepReport, HasARowForEachCaseThatLeadsToItsRuns) {
  const reports::Report made = report();
  ASSERT_EQ(made.sections.size(), 1u);
  EXPECT_TRUE(made.claims.empty());
  const ResultTable& cases = table(made, "cases");
  ASSERT_EQ(cases.rows.size(), 12u * 6u);
  for (const auto& row : cases.rows) {
    EXPECT_EQ(row.runs.size(), results::text_in(cases, row, "status") == "ok" ? 6u : 1u);
    for (const std::string& run : row.runs) EXPECT_TRUE(made.runs.contains(run)) << run;
  }
  const std::string& command = made.runs.at(cases.rows[0].runs[0]).command;
  EXPECT_NE(command.find("-o again.vtu --report again.json"), std::string::npos) << command;
}

TEST_F(SweepReport, CountsFailuresByKind) {
  const reports::Report made = report();
  const ResultTable &cases = table(made, "cases"), &failures = table(made, "failures");
  std::map<std::string, double> kinds;
  for (const auto& row : cases.rows)
    if (const std::string kind = results::text_in(cases, row, "failure"); !kind.empty()) ++kinds[kind];
  ASSERT_GE(kinds.size(), 2u);
  for (const auto& [kind, count] : kinds) EXPECT_EQ(sum_of(failures, kind), count) << kind;
  EXPECT_TRUE(result_of(made).is_good) << "the failures are those of others";
}

TEST_F(SweepReport, FitsTheExponentsOfItsSeries) {
  const reports::Report made = report();
  const ResultTable& fits = table(made, "scaling");
  ASSERT_GE(fits.rows.size(), 12u);
  for (const auto& row : fits.rows) EXPECT_NEAR(results::number_in(fits, row, "exponent"), 1.05, 0.1);
  EXPECT_EQ(table(made, "scaling_lines").rows.size(), 2 * fits.rows.size());
}

TEST_F(SweepReport, ComparesTwoMeshersCaseByCase) {
  const reports::Report made = report();
  const ResultTable& pairs = table(made, "pairs_summary");
  ASSERT_EQ(pairs.rows.size(), 2u);
  EXPECT_EQ(sum_of(pairs, "both"), table(made, "pairs").rows.size());
  EXPECT_EQ(sum_of(pairs, "both") + sum_of(pairs, "only_first"), 2 * 12 * 4);
  for (const auto& row : pairs.rows) EXPECT_LT(results::number_in(pairs, row, "ratio"), 1);
}

TEST_F(SweepReport, PutsOnlyWhatNothingBeatsOnTheFront) {
  const reports::Report made = report();
  const ResultTable& pareto = table(made, "pareto");
  ASSERT_FALSE(pareto.rows.empty());
  for (const auto& row : pareto.rows) {
    const auto number = [&](const auto& r, const char* name) { return results::number_in(pareto, r, name); };
    const bool is_beaten = std::ranges::any_of(pareto.rows, [&](const auto& other) {
      return results::text_in(pareto, other, "group") == results::text_in(pareto, row, "group") &&
             number(other, "seconds") < number(row, "seconds") && number(other, "worst_r") < number(row, "worst_r");
    });
    EXPECT_EQ(is_beaten && results::text_in(pareto, row, "front") == "yes", false);
  }
}

TEST_F(SweepReport, KnowsWhichStrategiesMustGiveTheSameMesh) {
  const ResultTable same = table(report(), "same_mesh");
  ASSERT_EQ(same.rows.size(), 12u * 2u) << "one for each input and lattice";
  for (const auto& row : same.rows) EXPECT_EQ(results::text_in(same, row, "same"), "yes");
  for (int number = 0; number <= 6; ++number) {
    Json run = read(record(number));
    run["mesh_fingerprint"] = "another";
    write(run, record(number));
  }
  const reports::Report made = report();
  EXPECT_FALSE(result_of(made).is_good);
  EXPECT_EQ(std::ranges::count_if(
                table(made, "same_mesh").rows,
                [&](const auto& r) { return results::text_in(table(made, "same_mesh"), r, "same") == "no"; }),
            1);
}

TEST_F(SweepReport, SaysWhichTimesSpreadTooWide) {
  for (int number = 1; number <= 6; ++number) {
    Json run = read(record(number));
    run["seconds"]["mesh"] = number;
    write(run, record(number));
  }
  const reports::Report made = report();
  const ResultTable& cases = table(made, "cases");
  EXPECT_NE(results::text_in(cases, cases.rows[0], "spread"), "");
  EXPECT_EQ(results::number_in(cases, cases.rows[0], "seconds"), 3.5) << "the warm-up run does not count";
}

TEST_F(SweepReport, ShowsNoIntervalOfFewerThanSixRuns) {
  std::filesystem::remove(folder() / record(6));
  const reports::Report made = report();
  const ResultTable& cases = table(made, "cases");
  const auto seconds = [&](std::size_t row) {
    return std::get<bench::Estimate>(results::cell(cases, cases.rows[row], "seconds"));
  };
  EXPECT_FALSE(seconds(0).has_interval());
  EXPECT_GT(seconds(0).value, 0);
  EXPECT_EQ(results::text_in(cases, cases.rows[0], "spread"), "");
  EXPECT_TRUE(seconds(1).has_interval());
}

TEST_F(SweepReport, TakesTornRecordsForMissingOnes) {
  for (int number = 0; number <= 6; ++number) std::filesystem::resize_file(folder() / record(number), 100);
  const reports::Report made = report();
  EXPECT_EQ(results::text_in(table(made, "cases"), table(made, "cases").rows[0], "status"), "not run");
  EXPECT_EQ(made.runs.count(record(1)), 0u);
}

TEST_F(SweepReport, WritesALineForEachRun) {
  const reports::Report made = report();
  const auto csv = lines_of(made.more_files.at("runs.csv")), json = lines_of(made.more_files.at("runs.jsonl"));
  const auto records = std::distance(std::filesystem::directory_iterator(folder() / "runs"), {});
  ASSERT_EQ(csv.size(), static_cast<std::size_t>(records) + 1);
  ASSERT_EQ(json.size(), static_cast<std::size_t>(records));
  EXPECT_TRUE(csv[0].starts_with("case,number,counted,file,name,input,"));
  EXPECT_NE(csv[0].find(",option_lattice,option_locator"), std::string::npos);
  std::string names;
  const Json first = Json::parse(json[0]);
  for (const auto& [name, value] : first.items()) names += (names.empty() ? "" : ",") + name;
  EXPECT_EQ(names + "\r", csv[0]);
  EXPECT_EQ(Json::parse(json[0]).at("tetrahedra"), 10000);
  EXPECT_EQ(Json::parse(json[0]).at("counted"), "no");
}

TEST_F(SweepReport, NamesItsColumnsInTheHelp) {
  const std::string help = results::run_columns_help();
  const std::string names = lines_of(report().more_files.at("runs.csv"))[0];
  std::istringstream words(help);
  for (std::string word; words >> word;)
    EXPECT_TRUE(word == "option_NAME" || ("," + names).find("," + word + ",") != std::string::npos) << word;
}

TEST_F(SweepReport, LeavesRawRecordsOutOfThePage) {
  const reports::Report made = report();
  const std::string page = reports::fill_page("<!-- ccdt data -->", made, folder());
  EXPECT_EQ(page.find("histogram"), std::string::npos);
  EXPECT_FALSE(made.has_raw_runs);
}

TEST_F(SweepReport, ComparedWithAnotherSaysWhatDiffers) {
  write_made_up_sweep({.failing = 0.2, .slowness = 2}, folder("slow"));
  const reports::Report made = reports::compare_reports(folder(), folder("slow"), folder("slow") / "comparison", {});
  EXPECT_TRUE(table(made, "differences").rows.empty());
  const ResultTable& times = table(made, "times");
  ASSERT_GT(times.rows.size(), 50u);
  for (const auto& row : times.rows) {
    if (results::text_in(times, row, "table") != "Cases") continue;
    EXPECT_NEAR(results::number_in(times, row, "ratio"), 2, 1e-9);
  }

  Json run = read(record(1));
  run["counts"]["tetrahedra"] = 1;
  write(run, record(1));
  const reports::Report other = reports::compare_reports(folder(), folder("slow"), folder("slow") / "comparison", {});
  EXPECT_FALSE(table(other, "differences").rows.empty());
}

reports::ReportChart map_of(const std::string& column) {
  reports::ReportChart chart{"sweep", "map", "{first title}", "", {"cases"}, R"({"x":"{first}","y":"{second}"})"};
  chart.map_of = column;
  return chart;
}

TEST_F(SweepReport, HasMapsOfTheAxesThatVary) {
  const auto made = reports::charts_for(result_of(report()), std::vector{map_of("seconds")});
  ASSERT_FALSE(made.empty());
  EXPECT_EQ(made[0].name, "map-lattice-locator");
  EXPECT_EQ(made[0].spec, R"({"x":"lattice","y":"locator"})");
}

TEST_F(SweepReport, HasNoMapsOfAxesWithoutAnEffect) {
  const auto made = reports::charts_for(result_of(report()), std::vector{map_of("worst_r")});
  ASSERT_FALSE(made.empty());
  for (const auto& chart : made) EXPECT_EQ(chart.name.find("locator"), std::string::npos) << chart.name;
}

TEST_F(SweepReport, HasOnlyTheChartsThatItsDataFill) {
  reports::ReportChart chart{"sweep", "many", "", "", {"cases"}, "{}", {{"cases", "input", 12}}};
  EXPECT_EQ(reports::charts_for(result_of(report()), std::vector{chart}).size(), 1u);
  chart.needs[0].values = 13;
  EXPECT_TRUE(reports::charts_for(result_of(report()), std::vector{chart}).empty());
}

}  // namespace
}  // namespace ccdt
