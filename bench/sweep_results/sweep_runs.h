#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/case.h"
#include "bench/sweep_results/run_values.h"

namespace ccdt::sweep_results {

struct NumberedRun {
  int number = 0;
  std::string file;  ///< relative to the folder
  RunValues values;
};

/// A case of a sweep with all its runs.
struct SweepCase {
  std::string id, name, group;
  std::string input, input_file;
  std::string model;                  ///< empty: the input is a file of the user's
  std::optional<double> edge_length;  ///< of a model
  std::string mesher;
  std::vector<std::string> options;  ///< one for each of `Sweep::options`; empty: not used by this mesher
  bench::Repetitions wanted;
  std::vector<NumberedRun> runs = {};  ///< by number; none: the case has not run yet
};

/// A folder that `ccdt sweep` has filled, or is filling.
struct Sweep {
  std::string name;
  std::vector<std::string> options;  ///< options of any case: "lattice", "face-protection"
  std::vector<SweepCase> cases;
  double limit_seconds = 0;        ///< seconds of a run; 0: none
  double limit_bytes = 0;          ///< bytes of memory of a run
  bool is_mixed = false;           ///< contains records with other identities
  std::size_t broken_records = 0;  ///< files that are not records; they count as missing
};

/// The description of a sweep in its folder.
inline constexpr const char* sweep_file = "sweep.json";

/// Reads a sweep and all records of its cases, on all cores.
/// \throw InputError  the folder has no sweep.json of schema `ccdt.sweep/1`
Sweep read_sweep(const std::filesystem::path& folder);

}  // namespace ccdt::sweep_results
