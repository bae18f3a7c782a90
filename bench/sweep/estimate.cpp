#include "bench/sweep/estimate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/run/numbers.h"
#include "bench/run/statistics.h"
#include "bench/sweep/input_size.h"

namespace ccdt::sweep {
namespace {

// Figures for a mesher without finished cases; measured with ours and TetGen on one core of an ordinary machine.
constexpr double usual_seconds = 12e-6;  ///< per tetrahedron
constexpr double usual_check_seconds = 6e-6;
constexpr double usual_bytes = 400;

// The part that does not depend on the size.
constexpr double seconds_of_process = 0.02;
constexpr double bytes_of_process = 15e6;
constexpr double bytes_of_record = 12e3;

constexpr double mesh_bytes = 77;   ///< of a mesh, per tetrahedron
constexpr double model_bytes = 50;  ///< of a model, per triangle

constexpr double least_exponent = 0.3, largest_exponent = 2;  ///< shorter ones are noise
constexpr std::size_t fewest_for_fit = 3;

/// A quantity of finished cases by estimated size.
struct Samples {
  std::vector<double> size, value;

  void add(double at, double what) {
    size.push_back(at);
    value.push_back(std::max(what, 1e-9));
  }

  /// Estimates by a power law, or with few samples in proportion to the size.
  double at(double wanted) const {
    const auto [least, most] = std::ranges::minmax(size);
    if (size.size() >= fewest_for_fit && most > 1.5 * least) {
      const bench::LineFit fit = bench::fit_power(size, value);
      if (fit.slope.value >= least_exponent && fit.slope.value <= largest_exponent)
        return std::exp(fit.intercept + fit.slope.value * std::log(wanted));
    }
    std::vector<double> ratios;
    for (std::size_t i = 0; i < size.size(); ++i) ratios.push_back(value[i] / size[i]);
    return wanted * bench::median(ratios);
  }
};

struct Neighbors {
  Samples seconds, bytes, check;
};

double seconds_of(const bench::RunRecord& record) {
  return record.read_seconds + record.costs[Stage::remesh].seconds + record.costs.mesh_seconds + record.write_seconds;
}

void add_case(Neighbors& neighbors, double tetrahedra, const bench::MeasuredCase& measured) {
  neighbors.seconds.add(tetrahedra, seconds_of(measured.first));
  const double bytes = static_cast<double>(measured.first.peak_rss_bytes) - bytes_of_process;
  if (bytes > 0) neighbors.bytes.add(tetrahedra, bytes);  // a small case says nothing about larger ones
  if (measured.first.verification) neighbors.check.add(tetrahedra, measured.first.verification->seconds);
}

/// Mesher and options, or the mesher alone.
using Kind = std::string;
Kind mesher_of(const SweepCase& one) {
  return one.asked.mesher;
}
Kind kind_of(const SweepCase& one) {
  return one.asked.mesher + " " + bench::joined(one.asked.options, " ");
}

bool is_neighbor(const bench::MeasuredCase& measured) {
  return measured.runs > 0 && !measured.failed();
}

void set_usual(CaseEstimate& estimate) {
  estimate.seconds = usual_seconds * estimate.tetrahedra;
  estimate.check_seconds = usual_check_seconds * estimate.tetrahedra;
  estimate.memory_bytes = usual_bytes * estimate.tetrahedra;
}

void set_from(CaseEstimate& estimate, const Neighbors& neighbors) {
  estimate.neighbors = static_cast<int>(neighbors.seconds.size.size());
  estimate.seconds = neighbors.seconds.at(estimate.tetrahedra);
  if (!neighbors.bytes.size.empty()) estimate.memory_bytes = neighbors.bytes.at(estimate.tetrahedra);
  if (!neighbors.check.size.empty()) estimate.check_seconds = neighbors.check.at(estimate.tetrahedra);
}

void count_runs(CaseEstimate& estimate, const bench::MeasuredCase& measured) {
  const bench::RunsLeft left = bench::runs_left(measured);
  estimate.runs = left.least;
  estimate.most_runs = left.most;
}

/// "2 h 10 min"
std::string duration(double seconds) {
  constexpr double minute = 60, hour = 3600, day = 86400;
  if (seconds < 1) return "less than 1 s";
  if (seconds < 2 * minute) return bench::rounded(seconds, 2) + " s";
  if (seconds < 2 * hour) return bench::rounded(seconds / minute, 2) + " min";
  if (seconds < 2 * day) return bench::rounded(seconds / hour, 2) + " h";
  return bench::rounded(seconds / day, 2) + " days";
}

std::string bytes_words(double bytes) {
  return bench::mebibytes(static_cast<std::uint64_t>(bytes));
}

}  // namespace

std::vector<CaseEstimate> estimate_cases(std::span<const SweepCase> cases,
                                         std::span<const bench::MeasuredCase> measured) {
  std::vector<CaseEstimate> estimates(cases.size());
  std::map<Kind, Neighbors> of_mesher, of_kind;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    estimates[i].tetrahedra = estimated_tetrahedra(size_of(cases[i].input), cases[i].options);
    if (!is_neighbor(measured[i])) continue;
    add_case(of_mesher[mesher_of(cases[i])], estimates[i].tetrahedra, measured[i]);
    add_case(of_kind[kind_of(cases[i])], estimates[i].tetrahedra, measured[i]);
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    CaseEstimate& estimate = estimates[i];
    const auto kind = of_kind.find(kind_of(cases[i])), mesher = of_mesher.find(mesher_of(cases[i]));
    set_usual(estimate);
    if (kind != of_kind.end())
      set_from(estimate, kind->second);
    else if (mesher != of_mesher.end())
      set_from(estimate, mesher->second);
    estimate.seconds += seconds_of_process;
    estimate.memory_bytes += bytes_of_process;
    const baselines::Limits& limits = cases[i].asked.limits;
    if (limits.seconds > 0) estimate.seconds = std::min(estimate.seconds, limits.seconds);
    if (limits.memory_bytes > 0)
      estimate.memory_bytes = std::min(estimate.memory_bytes, static_cast<double>(limits.memory_bytes));
    if (!cases[i].asked.verify) estimate.check_seconds = 0;
    count_runs(estimate, measured[i]);
  }
  return estimates;
}

SweepEstimate sum_of(std::span<const SweepCase> cases, std::span<const bench::MeasuredCase> measured,
                     std::span<const CaseEstimate> estimates) {
  SweepEstimate sum;
  sum.cases = cases.size();
  std::set<std::filesystem::path> models;
  std::set<std::string> unknown;
  double largest_mesh = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const CaseEstimate& estimate = estimates[i];
    if (is_neighbor(measured[i])) ++sum.finished_cases;
    sum.runs += static_cast<std::size_t>(measured[i].runs + estimate.runs);
    if (estimate.runs == 0) continue;
    ++sum.missing_cases;
    sum.missing_runs += static_cast<std::size_t>(estimate.runs);
    sum.seconds += estimate.missing_seconds();
    sum.most_seconds += estimate.missing_seconds() + (estimate.most_runs - estimate.runs) * estimate.seconds;
    sum.memory_bytes = std::max(sum.memory_bytes, estimate.memory_bytes);
    sum.disk_bytes += estimate.most_runs * bytes_of_record;
    largest_mesh = std::max(largest_mesh, mesh_bytes * estimate.tetrahedra);
    if (!cases[i].asked.mesh_ending.empty()) sum.disk_bytes += mesh_bytes * estimate.tetrahedra;
    if (!std::filesystem::exists(cases[i].input.file) && models.insert(cases[i].input.file).second)
      sum.disk_bytes += model_bytes * size_of(cases[i].input).triangles;
    if (estimate.neighbors == 0) unknown.insert(cases[i].mesher);
  }
  sum.disk_bytes += largest_mesh;  // every mesh is written, and removed if it is not kept
  sum.unknown_meshers.assign(unknown.begin(), unknown.end());
  return sum;
}

bench::Json to_json(const SweepEstimate& estimate) {
  return {{"schema", "ccdt.estimate/1"},
          {"cases", estimate.cases},
          {"runs", estimate.runs},
          {"missing_cases", estimate.missing_cases},
          {"missing_runs", estimate.missing_runs},
          {"seconds", estimate.seconds},
          {"most_seconds", estimate.most_seconds},
          {"memory_bytes", std::round(estimate.memory_bytes)},
          {"disk_bytes", std::round(estimate.disk_bytes)},
          {"finished_cases", estimate.finished_cases},
          {"unknown_meshers", estimate.unknown_meshers}};
}

std::string in_words(const SweepEstimate& estimate) {
  using bench::with_separators;
  std::string text = with_separators(estimate.cases) + " cases, " + with_separators(estimate.runs) +
                     " runs; missing: " + with_separators(estimate.missing_cases) + " cases, " +
                     with_separators(estimate.missing_runs) + " runs\n";
  if (estimate.missing_runs == 0) return text;
  text += "time    " + std::string(estimate.seconds < 1 ? "" : "about ") + duration(estimate.seconds);
  if (estimate.most_seconds > 1.05 * estimate.seconds)
    text += ", up to " + duration(estimate.most_seconds) + " if times spread";
  text += "\nmemory  about " + bytes_words(estimate.memory_bytes) + " for the largest run\ndisk    about " +
          bytes_words(estimate.disk_bytes) + "\n";
  text += estimate.finished_cases == 0
              ? "estimated from sizes alone, without any finished case: times may be wrong by a factor of 3\n"
              : "estimated from sizes and " + with_separators(estimate.finished_cases) + " finished cases\n";
  if (estimate.finished_cases > 0 && !estimate.unknown_meshers.empty())
    text += "no finished case yet: " + bench::joined(estimate.unknown_meshers) + "\n";
  return text;
}

}  // namespace ccdt::sweep
