#include "bench/experiments/experiment.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "baselines/mesher.h"
#include "engine/base/errors.h"

namespace ccdt::experiments {
namespace {

constexpr int most_runs = 60;

/// Seconds for all runs of a case, so that long ones are run less often: one second where minutes are wanted, five with
/// 100,000 tetrahedra per model.
double budget(const ExperimentOptions& options) {
  return std::max(1.0, options.tetrahedra / 20000);
}

}  // namespace

Circumstances start_experiment(const ExperimentOptions& options, int runs) {
  for (const char* folder : {"models", "meshes", "runs"}) std::filesystem::create_directories(options.folder / folder);
  return {.environment = bench::capture_environment(),
          .runs = runs,
          .confidence = bench::usual_confidence,
          .limits = options.limits,
          .tetrahedra = options.tetrahedra,
          .scale = options.scale,
          .command = options.command};
}

double edge_factor(const ExperimentOptions& options) {
  constexpr double usual_tetrahedra = 100000;
  return std::cbrt(usual_tetrahedra / options.tetrahedra);
}

bool is_chosen(const ExperimentOptions& options, std::string_view model) {
  return options.models.empty() || std::ranges::find(options.models, model) != options.models.end();
}

bool is_measured(const ExperimentOptions& options, std::string_view mesher) {
  if (options.beside && mesher != "ccdt") return std::ranges::find(*options.beside, mesher) != options.beside->end();
  return std::ranges::find(baselines::meshers(), mesher, &baselines::Mesher::name) != baselines::meshers().end();
}

bool is_timed(const ExperimentOptions& options, std::string_view mesher) {
  constexpr double fewest_of_mesh3 = 50000;
  return is_measured(options, mesher) && (mesher != "cgal-mesh3" || options.tetrahedra >= fewest_of_mesh3);
}

std::vector<std::string> described_meshers(const ExperimentOptions& options) {
  std::vector<std::string> files;
  if (options.beside)
    std::ranges::copy_if(*options.beside, std::back_inserter(files), baselines::is_mesher_description);
  return files;
}

void check_something_is_measured(std::size_t cases, std::string_view experiment) {
  if (cases == 0)
    throw InputError("none of these models is part of the experiment " + std::string(experiment), {},
                     "without --models, it measures all its models");
}

bench::Case single_case(const ExperimentOptions& options, std::string name, std::string mesher,
                        const std::filesystem::path& input, std::vector<std::string> words) {
  return {.name = std::move(name),
          .group = {},
          .mesher = std::move(mesher),
          .input = input,
          .options = std::move(words),
          .limits = options.limits,
          .verify = true};
}

bench::Case timed_case(const ExperimentOptions& options, std::string group, const bench::Case& single, double until,
                       bench::SecondsOf seconds) {
  bench::Case timed = single;
  timed.group = std::move(group);
  timed.seconds = std::move(seconds);
  timed.repetitions = {.warm_up = 1,
                       .at_least = options.runs,
                       .at_most = std::max(options.runs, most_runs),
                       .until = until,
                       .budget_seconds = budget(options)};
  return timed;
}

bool is_short(const ExperimentOptions& options, const bench::MeasuredCase& first) {
  return !first.failed() && options.runs * first.first.costs.mesh_seconds <= budget(options);
}

std::string short_case_words(const ExperimentOptions& options) {
  return "A case is run only once, and its seconds have no interval, if " + std::to_string(options.runs) +
         " runs of it would take more than " + rounded(budget(options), 2) + " s.";
}

std::string repetition_words(const ExperimentOptions& options, double until) {
  std::vector<std::string> looks;
  for (const int look : bench::looks_between(options.runs, std::max(options.runs, most_runs)))
    looks.push_back(std::to_string(look));
  return "A case is repeated " + joined(looks, " or ") + " times: until the interval of its median is within " +
         rounded(100 * until, 1) + "% of it, or the next number would take more than " + rounded(budget(options), 2) +
         " s. The intervals, between order statistics, cover in 95% of all cases with this rule.";
}

std::string choose(BoundTest test, std::string_view holds, std::string_view undecided, std::string_view fails) {
  return std::string(test == BoundTest::holds ? holds : test == BoundTest::fails ? fails : undecided);
}

void add_problem(ExperimentResult& result, std::string problem, bool is_ours) {
  result.problems.push_back(std::move(problem));
  result.is_good = result.is_good && !is_ours;
}

void add_problem_of(const CaseRow& row, ExperimentResult& result) {
  if (!row.ok()) add_problem(result, row.measured.asked.name + ": " + failure(row.measured), is_ours(row));
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream text(line);
  return {std::istream_iterator<std::string>(text), {}};
}

std::string share_words(std::uint64_t part, std::uint64_t whole) {
  return with_separators(part) + " of " + with_separators(whole);
}

}  // namespace ccdt::experiments
