#include "bench/experiments/experiment.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "baselines/mesher.h"
#include "engine/base/errors.h"

namespace ccdt::experiments {
namespace {

std::string quoted_for_shell(const std::string& word) {
  const bool is_plain = !word.empty() && word.find_first_not_of(
                                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                             "0123456789-_./=:,+@%") == std::string::npos;
  if (is_plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

}  // namespace

Circumstances start_experiment(const ExperimentOptions& options, int runs) {
  for (const char* folder : {"models", "meshes", "runs"}) std::filesystem::create_directories(options.folder / folder);
  return {.environment = bench::capture_environment(),
          .runs = runs,
          .confidence = bench::Bootstrap{}.confidence,
          .limits = options.limits,
          .tetrahedra = options.tetrahedra,
          .scale = options.scale,
          .command = options.command};
}

double edge_factor(const ExperimentOptions& options) {
  constexpr double usual_tetrahedra = 100000;
  return std::cbrt(usual_tetrahedra / options.tetrahedra);
}

bool is_asked_for(const ExperimentOptions& options, std::string_view model) {
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
                     "leave out --models, and it measures all that it has");
}

BoundTest is_at_most(const Estimate& estimate, double bound) {
  if (estimate.high <= bound) return BoundTest::holds;
  return estimate.low > bound ? BoundTest::fails : BoundTest::undecided;
}

BoundTest is_at_least(const Estimate& estimate, double bound) {
  if (estimate.low >= bound) return BoundTest::holds;
  return estimate.high < bound ? BoundTest::fails : BoundTest::undecided;
}

std::string choose(BoundTest test, std::string_view holds, std::string_view undecided, std::string_view fails) {
  return std::string(test == BoundTest::holds ? holds : test == BoundTest::fails ? fails : undecided);
}

void add_problem(ExperimentResult& result, std::string problem, bool is_ours) {
  result.problems.push_back(std::move(problem));
  result.is_good = result.is_good && !is_ours;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream text(line);
  return {std::istream_iterator<std::string>(text), {}};
}

std::string command_line(const std::vector<std::string>& command) {
  std::string line;
  for (const std::string& word : command) line += (line.empty() ? "" : " ") + quoted_for_shell(word);
  return line;
}

std::string share_words(std::uint64_t part, std::uint64_t whole) {
  return with_separators(part) + " of " + with_separators(whole);
}

}  // namespace ccdt::experiments
