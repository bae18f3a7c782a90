#include "reports/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/run/run_record.h"
#include "engine/base/errors.h"

namespace ccdt {
namespace {

/// A folder with one experiment based on one run.
class ReportFolder : public testing::Test {
 protected:
  ReportFolder() {
    std::string name = testing::TempDir() + "/ccdt-report-XXXXXX";
    root_ = mkdtemp(name.data());
    fill("a", 1.0, 100);
  }
  ~ReportFolder() override { std::filesystem::remove_all(root_); }

  std::filesystem::path folder(const std::string& name) const { return root_ / name; }

  void fill(const std::string& name, double seconds, double count) const {
    std::filesystem::create_directories(folder(name) / "runs");
    bench::RunRecord run;
    run.mesher = {"ccdt", "0.1", "abc"};
    run.command = {"ccdt", "mesh", "models/my part.off", "-o", "meshes/x.vtu", "--report", "runs/x-1.json"};
    bench::write_run_record(run, folder(name) / "runs/x-1.json");
    results::ExperimentResult result{.name = "table1", .title = "Table 1"};
    result.how.scale = "full";
    results::ResultTable table{"times",
                               "Seconds",
                               {{"model", "model", results::ColumnKind::label},
                                {"count", "count"},
                                {"seconds", "seconds", results::ColumnKind::time, "s"}}};
    table.rows = {
        {{std::string("piston"), count, bench::Estimate{seconds, 0.9 * seconds, 1.1 * seconds}}, {"runs/x-1.json"}}};
    result.tables = {table};
    results::write_experiment_result(result, folder(name));
  }

 private:
  std::filesystem::path root_;
};

const reports::ReportSection& section(const reports::Report& report, const std::string& name) {
  const auto found = std::ranges::find(report.sections, name, [](const auto& s) { return s.result.name; });
  if (found == report.sections.end()) throw std::out_of_range(name);
  return *found;
}

TEST_F(ReportFolder, LeadsFromANumberToTheCommandThatRepeatsIt) {
  const reports::Report report = reports::read_report(folder("a"), {});
  EXPECT_EQ(report.runs.at("runs/x-1.json").command, "ccdt mesh 'models/my part.off' -o again.vtu --report again.json");
  EXPECT_EQ(report.runs.at("runs/x-1.json").status, "ok");
}

TEST_F(ReportFolder, SaysWhatIsMissingAndHowToMakeIt) {
  const reports::Report report = reports::read_report(folder("a"), {});
  const reports::ReportSection& fig8 = section(report, "fig8");
  EXPECT_TRUE(fig8.is_missing);
  EXPECT_NE(fig8.reason.find("fig8.json"), std::string::npos);
  EXPECT_EQ(fig8.result.how.command, "ccdt reproduce fig8 --scale full -o .");
  EXPECT_FALSE(section(report, "table1").is_missing);
}

TEST_F(ReportFolder, TakesABrokenExperimentForAMissingOne) {
  std::ofstream(folder("a") / "fig8.json") << "{";
  EXPECT_NE(section(reports::read_report(folder("a"), {}), "fig8").reason.find("fig8.json"), std::string::npos);
}

TEST_F(ReportFolder, GoesOnWithoutARun) {
  std::filesystem::remove(folder("a") / "runs/x-1.json");
  const reports::RunLine run = reports::read_report(folder("a"), {}).runs.at("runs/x-1.json");
  EXPECT_EQ(run.command, "");
  EXPECT_TRUE(run.status.starts_with("missing")) << run.status;
}

TEST_F(ReportFolder, RefusesAFolderWithoutAnyExperiment) {
  EXPECT_THROW(reports::read_report(folder("a") / "runs", {}), InputError);
}

TEST_F(ReportFolder, HasTheChartsWhoseTablesAreThere) {
  const std::vector<reports::ReportChart> charts = {{"table1", "times", "", "", {"times"}, "{}"},
                                                    {"table1", "ratios", "", "", {"times", "ratios"}, "{}"},
                                                    {"fig8", "times", "", "", {"times"}, "{}"}};
  const reports::Report report = reports::read_report(folder("a"), charts);
  const reports::ReportSection& found = section(report, "table1");
  ASSERT_EQ(found.charts.size(), 1u);
  EXPECT_EQ(found.charts[0].name, "times");
}

TEST_F(ReportFolder, PutsEverythingIntoThePage) {
  const reports::Report report = reports::read_report(folder("a"), {});
  const std::string page = reports::fill_page("<html>\n<!-- ccdt data -->\n</html>", report, folder("a"));
  EXPECT_NE(page.find(R"(<script type="application/json" id="ccdt-report">)"), std::string::npos);
  EXPECT_NE(page.find("again.vtu"), std::string::npos);
  EXPECT_NE(page.find(R"(id="ccdt-files">eN)"), std::string::npos);
  EXPECT_TRUE(page.ends_with("</html>"));
  EXPECT_THROW(reports::fill_page("<html></html>", report, folder("a")), std::logic_error);
}

TEST_F(ReportFolder, LetsNoTextEndOrOpenAScriptOfThePage) {
  reports::Report report = reports::read_report(folder("a"), {});
  report.title = "</script><script>alert(1) <!--<script>";
  const std::string page = reports::fill_page("<!-- ccdt data -->", report, folder("a"));
  EXPECT_EQ(page.find("</script><script>alert"), std::string::npos);
  EXPECT_EQ(page.find("<!--"), std::string::npos) << "it would hide the end of the script";
  const std::string begin = R"(<script type="application/json" id="ccdt-report">)";
  const std::size_t at = page.find(begin) + begin.size();
  EXPECT_EQ(bench::Json::parse(page.substr(at, page.find('<', at) - at))["title"], report.title);
}

const results::ResultTable& table_of(const reports::Report& report, const std::string& name) {
  return *results::find_table(report.sections.at(0).result, name);
}

TEST_F(ReportFolder, ComparedWithItselfIsTheSame) {
  fill("b", 1.05, 100);
  const reports::Report report = reports::compare_reports(folder("a"), folder("b"), folder("b") / "comparison", {});
  EXPECT_TRUE(table_of(report, "differences").rows.empty());
  ASSERT_EQ(table_of(report, "times").rows.size(), 1u);
  EXPECT_EQ(results::text_in(table_of(report, "times"), table_of(report, "times").rows[0], "within"), "yes");
  EXPECT_NEAR(results::number_in(table_of(report, "times"), table_of(report, "times").rows[0], "ratio"), 1.05, 1e-12);
  EXPECT_TRUE(report.sections[0].result.is_good);
  EXPECT_EQ(report.sections[0].result.findings[0].find("1 of 1 "), 0u) << report.sections[0].result.findings[0];
  EXPECT_EQ(report.runs.at("../runs/x-1.json").command.substr(0, 9), "cd .. && ");
}

TEST_F(ReportFolder, ComparedWithAnotherSaysWhatDiffers) {
  fill("b", 1.2, 101);
  const reports::Report report = reports::compare_reports(folder("a"), folder("b"), folder("b") / "comparison", {});
  ASSERT_EQ(table_of(report, "differences").rows.size(), 1u);
  EXPECT_EQ(results::number_in(table_of(report, "differences"), table_of(report, "differences").rows[0], "second"),
            101);
  EXPECT_EQ(results::text_in(table_of(report, "times"), table_of(report, "times").rows[0], "within"), "no");
  EXPECT_FALSE(report.sections[0].result.is_good);
}

}  // namespace
}  // namespace ccdt
