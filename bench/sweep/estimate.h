#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/run/case.h"
#include "bench/run/json.h"
#include "bench/sweep/expand.h"

namespace ccdt::sweep {

/// The expected cost of a case.
struct CaseEstimate {
  double tetrahedra = 0;     ///< from the size of the input and the wanted edge length
  double seconds = 0;        ///< of one run
  double check_seconds = 0;  ///< of the verification of its mesh, once
  double memory_bytes = 0;   ///< of one run
  int runs = 0;              ///< missing runs
  int most_runs = 0;         ///< missing runs if its times spread so much that it needs all repetitions
  int neighbors = 0;         ///< finished cases behind the estimates of time and memory; 0: default figures

  double missing_seconds() const { return runs * seconds + (runs > 0 ? check_seconds : 0); }
};

/// Estimates from finished cases of the same mesher, if there are any with the same options: a power law of time, and
/// one of memory, over the estimated number of tetrahedra.
///
/// \param cases, measured  the same cases; those without records have not run yet
std::vector<CaseEstimate> estimate_cases(std::span<const SweepCase> cases,
                                         std::span<const bench::MeasuredCase> measured);

/// The sum over a sweep.
struct SweepEstimate {
  std::size_t cases = 0, runs = 0;  ///< all runs, at least
  std::size_t missing_cases = 0, missing_runs = 0;
  double seconds = 0, most_seconds = 0;           ///< of what is missing
  double memory_bytes = 0;                        ///< largest memory of a missing run
  double disk_bytes = 0;                          ///< missing bytes: records, models, kept meshes, and temporary meshes
  std::size_t finished_cases = 0;                 ///< finished cases behind the estimate
  std::vector<std::string> unknown_meshers = {};  ///< without finished cases, estimated by default figures
};

SweepEstimate sum_of(std::span<const SweepCase> cases, std::span<const bench::MeasuredCase> measured,
                     std::span<const CaseEstimate> estimates);

bench::Json to_json(const SweepEstimate& estimate);

/// The estimate in a few lines.
std::string in_words(const SweepEstimate& estimate);

}  // namespace ccdt::sweep
