#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "baselines/external_program.h"
#include "bench/experiments/timing_experiments.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt {
namespace {

/// A repetition as Google Benchmark writes it.
bench::Json repetition(const std::string& name, int family, double milliseconds, double vertices, double cells) {
  return {{"name", name},     {"run_name", name},         {"family_index", family}, {"run_type", "iteration"},
          {"real_time", 1e9}, {"cpu_time", milliseconds}, {"time_unit", "ms"},      {"vertices", vertices},
          {"cells", cells}};
}

void add(bench::Json& runs, const std::string& name, int family, double milliseconds, double vertices, double cells) {
  for (const double factor : {1.0, 1.1, 0.9, 1.0, 1.0, 1.0})
    runs.push_back(repetition(name, family, factor * milliseconds, vertices, cells));
}

bench::Json good_runs() {
  bench::Json runs = bench::Json::array();
  add(runs, "delaunay/tetgen/random/1000", 3, 20, 1000, 6000);
  add(runs, "delaunay/insert/lattice/300", 4, 1, 300, 1500);
  add(runs, "delaunay/insert/random/1000", 0, 4, 1000, 6000);
  add(runs, "delaunay/insert/random/300", 0, 1, 300, 1700);
  add(runs, "delaunay/wrap/random/1000", 1, 12, 1000, 6000);
  add(runs, "delaunay/cgal/random/1000", 2, 8, 1000, 6000);
  add(runs, "delaunay/cgal/lattice/300", 6, 3, 300, 1400);
  add(runs, "delaunay/insert/part.off", 8, 2, 500, 3000);
  runs.push_back({{"run_name", "delaunay/insert/random/1000"}, {"run_type", "aggregate"}, {"cpu_time", 99}});
  return runs;
}

results::ExperimentResult evaluated(const bench::Json& runs) {
  results::ExperimentResult result;
  experiments::evaluate_delaunay(bench::Json{{"context", {}}, {"benchmarks", runs}}.dump(), result);
  return result;
}

/// Does one of the findings contain all of these?
bool is_found(const results::ExperimentResult& result, const std::vector<std::string>& data) {
  return std::ranges::any_of(result.findings, [&](const std::string& finding) {
    return std::ranges::all_of(data, [&](const std::string& one) { return finding.find(one) != std::string::npos; });
  });
}

TEST(DelaunayExperiment, OrdersPointsAndSizesAndTakesMedians) {
  const results::ExperimentResult result = evaluated(good_runs());
  const results::ResultTable& times = *results::find_table(result, "times");
  std::string rows;
  for (const results::ResultRow& row : times.rows)
    rows += results::text_in(times, row, "points") + " " + results::text_in(times, row, "size") + " " +
            results::text_in(times, row, "method") + "\n";
  EXPECT_EQ(rows,
            "uniform random 300 insert\nuniform random 1000 insert\nuniform random 1000 wrap\n"
            "uniform random 1000 CGAL\nuniform random 1000 TetGen\nFCC lattice 300 insert\nFCC lattice 300 CGAL\n"
            "part.off  insert\n");
  const results::ResultRow& insert = times.rows[1];
  EXPECT_EQ(results::text_in(times, insert, "status"), "ok");
  EXPECT_DOUBLE_EQ(results::number_in(times, insert, "seconds"), 0.004);
  EXPECT_DOUBLE_EQ(results::number_in(times, insert, "microseconds_per_vertex"), 4);
  EXPECT_EQ(results::number_in(times, insert, "vertices"), 1000);
  EXPECT_EQ(results::number_in(times, insert, "tetrahedra"), 6000);
}

TEST(DelaunayExperiment, ComparesTheMethodsOnTheSamePoints) {
  const results::ExperimentResult result = evaluated(good_runs());
  const results::ResultTable& ratios = *results::find_table(result, "ratios");
  ASSERT_EQ(ratios.rows.size(), 4u);
  EXPECT_DOUBLE_EQ(results::number_in(ratios, ratios.rows[1], "insert_over_cgal"), 0.5);
  EXPECT_DOUBLE_EQ(results::number_in(ratios, ratios.rows[1], "wrap_over_insert"), 3);
  EXPECT_DOUBLE_EQ(results::number_in(ratios, ratios.rows[1], "tetgen_over_insert"), 5);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(results::cell(ratios, ratios.rows[0], "insert_over_cgal")));
  EXPECT_TRUE(is_found(result, {"uniform random, 1,000", "insert", "0.50", "CGAL"}));
  EXPECT_TRUE(is_found(result, {"insert 1.20"}));
  EXPECT_TRUE(result.is_good);
  EXPECT_TRUE(result.problems.empty());
}

TEST(DelaunayExperiment, WantsEqualNumbersWhereTheyMustBeEqual) {
  bench::Json runs = good_runs();
  for (bench::Json& run : runs)
    if (run["run_name"] == "delaunay/cgal/random/1000") run["cells"] = 5999;
  const results::ExperimentResult theirs = evaluated(runs);
  EXPECT_EQ(theirs.problems.size(), 1u);
  EXPECT_TRUE(theirs.is_good);
  for (bench::Json& run : runs)
    if (run["run_name"] == "delaunay/wrap/random/1000") run["cells"] = 5999;
  EXPECT_FALSE(evaluated(runs).is_good);
}

TEST(DelaunayExperiment, MakesARowOfAFault) {
  for (const std::string method : {"tetgen", "wrap"}) {
    bench::Json runs = good_runs();
    for (bench::Json& run : runs)
      if (run["run_name"] == "delaunay/" + method + "/random/1000")
        run = {{"run_name", run["run_name"]},
               {"run_type", "iteration"},
               {"family_index", 3},
               {"error_occurred", true},
               {"error_message", "too bad"}};
    const results::ExperimentResult result = evaluated(runs);
    const results::ResultTable& times = *results::find_table(result, "times");
    EXPECT_EQ(std::ranges::count_if(times.rows,
                                    [&](const results::ResultRow& row) {
                                      return results::text_in(times, row, "status") == "failed" &&
                                             results::text_in(times, row, "reason") == "too bad";
                                    }),
              1);
    EXPECT_EQ(result.is_good, method == "tetgen");
    EXPECT_EQ(result.problems.size(), 1u);
  }
}

TEST(DelaunayExperiment, RefusesOtherJson) {
  results::ExperimentResult result;
  for (const char* text : {"", "{\"benchmarks\": [", "[]", R"({"benchmarks": [{"run_type": "iteration"}]})"})
    EXPECT_THROW(experiments::evaluate_delaunay(text, result), InputError) << text;
}

class DelaunayRuns : public testing::Test {
 protected:
  experiments::ExperimentOptions options() const {
    experiments::ExperimentOptions options;
    options.program = folder_.path() / "bin" / "ccdt";
    options.folder = folder_.path() / "report";
    options.tetrahedra = 1000;
    std::filesystem::create_directories(options.program.parent_path());
    std::filesystem::create_directories(options.folder);
    return options;
  }

  static results::ExperimentResult measured(const experiments::ExperimentOptions& options) {
    bench::Runner runner({.program = options.program, .folder = options.folder});
    return experiments::measure_delaunay(options, runner);
  }

  void script(const std::string& body) const {
    const auto file = options().program.parent_path() / "bench_delaunay";
    std::ofstream(file) << "#!/bin/sh\n" << body << "\n";
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }

 private:
  baselines::TemporaryFolder folder_;
};

TEST_F(DelaunayRuns, WithoutTheProgramSayHowToBuildIt) {
  const results::ExperimentResult result = measured(options());
  EXPECT_TRUE(result.is_good);
  ASSERT_EQ(result.problems.size(), 1u);
  EXPECT_NE(result.problems[0].find("cmake --build"), std::string::npos);
  ASSERT_NE(results::find_table(result, "times"), nullptr);
  EXPECT_TRUE(results::find_table(result, "times")->rows.empty());
  EXPECT_TRUE(result.raw_files.empty());
}

TEST_F(DelaunayRuns, KeepTheJsonAsItWasWritten) {
  const std::string text = bench::Json{{"benchmarks", good_runs()}}.dump();
  std::ofstream(options().program.parent_path() / "said.json") << text;
  script(R"(for word; do case $word in --benchmark_out=*) out=${word#*=};; esac; done
    cp "$(dirname "$0")/said.json" "$out"; exit 1)");
  const results::ExperimentResult result = measured(options());
  EXPECT_EQ(result.raw_files, std::vector<std::string>{"benchmarks/bench_delaunay.json"});
  EXPECT_EQ(io::read_whole_file(options().folder / result.raw_files.at(0)).bytes, text);
  EXPECT_EQ(results::find_table(result, "times")->rows.size(), 8u);
}

TEST_F(DelaunayRuns, AreNotRepeatedUnlessOthersAreWanted) {
  const auto folder = options().program.parent_path();
  std::ofstream(folder / "said.json") << bench::Json{{"benchmarks", good_runs()}}.dump();
  script(R"sh(for word; do
    case $word in --benchmark_out=*) out=${word#*=};; --benchmark_context=*) stamp=$word;; esac
  done
  cd "$(dirname "$0")"; echo run >> calls
  sed "s/\"benchmarks\"/\"context\": {\"stamp\": \"${stamp##*=}\"}, &/" said.json > "$out")sh");
  const auto calls = [&] { return std::filesystem::file_size(folder / "calls") / 4; };
  const results::ExperimentResult first = measured(options());
  EXPECT_EQ(calls(), 1u);
  EXPECT_EQ(results::to_json(measured(options())).size(), results::to_json(first).size());
  EXPECT_EQ(calls(), 1u);
  experiments::ExperimentOptions more = options();
  more.runs = 7;
  measured(more);
  EXPECT_EQ(calls(), 2u);
}

TEST_F(DelaunayRuns, ThatCrashAreRowsWithTheReason) {
  script(R"(for word; do case $word in --benchmark_out=*) echo '{"benchmarks": [' > "${word#*=}";; esac; done
    kill -SEGV $$)");
  const results::ExperimentResult result = measured(options());
  EXPECT_FALSE(result.is_good);
  EXPECT_TRUE(result.raw_files.empty());
  const results::ResultTable& times = *results::find_table(result, "times");
  ASSERT_FALSE(times.rows.empty());
  for (const results::ResultRow& row : times.rows) {
    EXPECT_EQ(results::text_in(times, row, "status"), "crashed");
    EXPECT_NE(results::text_in(times, row, "reason").find("SIGSEGV"), std::string::npos);
  }
}

TEST_F(DelaunayRuns, MeasureWhatIsAskedFor) {
  experiments::ExperimentOptions asked = options();
  const auto filter = [&] { return experiments::bench_delaunay_command("bench_delaunay", asked, "out.json").at(4); };
  asked.beside = std::vector<std::string>{};
  EXPECT_EQ(filter(), "--benchmark_filter=^delaunay/(insert|wrap)/(random|lattice|piston)(/[0-9]+)?$");
  asked.models = {"bracket"};
  asked.beside = std::vector<std::string>{"tetgen"};
  EXPECT_EQ(filter(), "--benchmark_filter=^delaunay/(insert|wrap|tetgen)/(random|lattice|bracket)(/[0-9]+)?$");
  asked.models = {"none"};
  EXPECT_THROW(measured(asked), InputError);
  asked.inputs = {"parts/a+b.off"};
  EXPECT_EQ(filter(), "--benchmark_filter=^delaunay/(insert|wrap|tetgen)/(a\\+b\\.off)(/[0-9]+)?$");
}

#ifdef BENCH_DELAUNAY
TEST_F(DelaunayRuns, OfTheProgramMeasureRandomPointsAndALattice) {
  experiments::ExperimentOptions real = options();
  real.program = std::filesystem::path(BENCH_DELAUNAY).parent_path() / "ccdt";
  const results::ExperimentResult result = measured(real);
  EXPECT_TRUE(result.is_good);
  EXPECT_TRUE(result.problems.empty());
  const results::ResultTable& times = *results::find_table(result, "times");
  ASSERT_GE(times.rows.size(), 4u);
  for (const results::ResultRow& row : times.rows) {
    EXPECT_EQ(results::text_in(times, row, "status"), "ok") << results::text_in(times, row, "reason");
    EXPECT_EQ(results::number_in(times, row, "vertices"), 1000);
  }
  EXPECT_EQ(results::find_table(result, "ratios")->rows.size(), 2u);
}
#endif

}  // namespace
}  // namespace ccdt
