#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/results/run_values.h"
#include "bench/sweep/sweep_document.h"

namespace ccdt::results {

struct NumberedRun {
  int number = 0;
  std::string file;  ///< relative to the folder
  RunValues values;
};

/// A case of a sweep with all its runs.
struct CaseRuns : sweep::SweepCase {
  std::vector<std::string> values = {};  ///< of each of `Sweep::options`; empty: not used by this mesher
  std::vector<NumberedRun> runs = {};    ///< by number; none: the case has not run yet
};

/// A folder that `ccdt sweep` has filled, or is filling.
struct Sweep {
  std::filesystem::path folder;
  std::string name;
  std::vector<std::string> options = {};  ///< options of any case: "lattice", "face-protection"
  std::vector<CaseRuns> cases = {};
  std::size_t broken_records = 0;  ///< files that are not records; they count as missing
};

/// Reads a sweep and all records of its cases, on all cores.
/// \throw InputError  the folder has no sweep.json of schema `ccdt.sweep/1`
Sweep read_sweep(const std::filesystem::path& folder);

}  // namespace ccdt::results
