#include "bench/run/case.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "bench/run/median_interval.h"

namespace ccdt::bench {

void add_run(MeasuredCase& measured, RunRecord record) {
  const bool failed = record.status != baselines::RunStatus::ok;
  const bool counts = !failed && measured.runs >= measured.asked.repetitions.warm_up;
  // A failure counts even after successful runs: a row with fewer samples than the others would not be fair.
  if (measured.runs == 0 || failed) measured.first = record;
  if (counts) measured.counted.push_back(std::move(record));
  ++measured.runs;
}

std::vector<int> looks_of(const Repetitions& repetitions) {
  if (repetitions.until <= 0) return {repetitions.at_least};
  return looks_between(repetitions.at_least, std::max(repetitions.at_least, repetitions.at_most));
}

bool are_enough(const Repetitions& repetitions, std::span<const double> samples, double mesh_seconds) {
  const std::vector<int> looks = looks_of(repetitions);
  const auto counted = static_cast<int>(samples.size());
  if (counted >= looks.back()) return true;
  const auto look = std::ranges::find(looks, counted);
  if (look == looks.end()) return false;  // a stop between looks would have to be paid by wider intervals
  const double budget = repetitions.budget_seconds, seconds_until_next = mesh_seconds / counted * *std::next(look);
  return (budget > 0 && seconds_until_next > budget) ||
         relative_spread(median_estimate(samples, looks)) <= repetitions.until;
}

bool needs_run(const MeasuredCase& measured) {
  const Repetitions& repetitions = measured.asked.repetitions;
  if (measured.failed()) return false;
  if (measured.runs < repetitions.warm_up) return true;
  const std::vector<double> seconds = samples_of(measured, &StageCosts::mesh_seconds);
  return !are_enough(repetitions, samples_of(measured, measured.asked.seconds),
                     std::accumulate(seconds.begin(), seconds.end(), 0.0));
}

RunsLeft runs_left(const MeasuredCase& measured) {
  if (!needs_run(measured)) return {};
  const std::vector<int> looks = looks_of(measured.asked.repetitions);
  const auto next = std::ranges::upper_bound(looks, static_cast<int>(measured.counted.size()));
  const int done = measured.runs - measured.asked.repetitions.warm_up;  // negative before all warm-up runs
  return {*next - done, looks.back() - done};
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
  for (const RunRecord& run : measured.counted) samples.push_back(seconds(run.costs));
  return samples;
}

Estimate median_of(const MeasuredCase& measured, const SecondsOf& seconds) {
  return median_estimate(samples_of(measured, seconds), looks_of(measured.asked.repetitions));
}

}  // namespace ccdt::bench
