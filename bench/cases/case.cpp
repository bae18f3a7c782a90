#include "bench/cases/case.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "bench/statistics.h"

namespace ccdt::cases {
namespace {

constexpr std::size_t enough_long_runs = 3;

bool is_over_budget(const MeasuredCase& measured, const std::vector<double>& samples) {
  const double budget = measured.asked.repetitions.budget_seconds;
  return budget > 0 && samples.size() >= enough_long_runs &&
         std::accumulate(samples.begin(), samples.end(), 0.0) >= budget;
}

}  // namespace

void add_run(MeasuredCase& measured, RunRecord record) {
  const bool failed = record.status != baselines::RunStatus::ok;
  const bool counts = !failed && measured.runs >= measured.asked.repetitions.warm_up;
  // A failure counts even after successful runs: a row with fewer samples than the others would not be fair.
  if (measured.runs == 0 || failed) measured.first = record;
  if (counts) measured.counted.push_back(std::move(record));
  ++measured.runs;
}

bool needs_run(const MeasuredCase& measured) {
  const Repetitions& repetitions = measured.asked.repetitions;
  if (measured.failed()) return false;
  const auto counted = static_cast<int>(measured.counted.size());
  if (measured.runs < repetitions.warm_up || counted == 0) return true;
  if (is_over_budget(measured, samples_of(measured, &StageSeconds::mesh))) return false;
  if (counted < repetitions.at_least) return true;
  if (repetitions.until <= 0 || counted >= repetitions.at_most) return false;
  return spread_of(samples_of(measured, measured.asked.seconds)) > repetitions.until;
}

std::string run_file(const std::string& id, int number) {
  return "runs/" + id + "-" + std::to_string(number) + ".json";
}

std::vector<std::string> run_files(const MeasuredCase& measured) {
  if (measured.runs == 0) return {};
  if (measured.failed()) return {run_file(measured.id, measured.runs - 1)};
  if (measured.counted.empty()) return {run_file(measured.id, 0)};
  std::vector<std::string> files;
  for (int number = measured.asked.repetitions.warm_up; number < measured.runs; ++number)
    files.push_back(run_file(measured.id, number));
  return files;
}

std::string mesh_file(const MeasuredCase& measured) {
  return "meshes/" + measured.id + measured.asked.mesh_ending;
}

std::vector<double> samples_of(const MeasuredCase& measured, const SecondsOf& seconds) {
  std::vector<double> samples;
  for (const RunRecord& run : measured.counted) samples.push_back(seconds(run.seconds));
  return samples;
}

double spread_of(const std::vector<double>& samples) {
  return samples.size() < 2 ? 0 : bench::relative_spread(bench::median_estimate(samples));
}

}  // namespace ccdt::cases
