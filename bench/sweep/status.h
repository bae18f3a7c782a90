#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "bench/run/case.h"
#include "bench/run/json.h"

namespace ccdt::sweep {

/// The progress of a sweep. Each case is finished, failed or missing.
struct SweepStatus {
  std::size_t cases = 0;
  std::size_t runs = 0;                         ///< record files in the folder
  std::size_t finished = 0;                     ///< cases with all their runs
  std::size_t failed = 0;                       ///< cases with a run that failed
  std::size_t missing = 0;                      ///< cases that need runs
  std::size_t obsolete = 0;                     ///< record files of no case
  std::map<std::string, std::size_t> failures;  ///< failed cases by the kind of the failure
};

/// The kind of a case's failure, or the status from records of older programs.
std::string failure_of(const bench::MeasuredCase& measured);

/// \param cases   as loaded by `bench::Runner`
/// \param folder  of the sweep
SweepStatus status_of(std::span<const bench::MeasuredCase> cases, const std::filesystem::path& folder);

bench::Json to_json(const SweepStatus& status);

/// The status in a few lines.
std::string in_words(const SweepStatus& status);

}  // namespace ccdt::sweep
