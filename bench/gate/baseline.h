#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/gate/recording.h"
#include "bench/gate/rules.h"
#include "bench/gate/verdict.h"
#include "bench/run/json.h"

namespace ccdt::gate {

/// Why a baseline changed, and by how much.
struct BaselineUpdate {
  std::string date;      ///< "2005-09-01"
  std::string reason;    ///< not empty
  std::string revision;  ///< revision of the measured source
  int changed = 0;       ///< number of figures that changed
  /// By layer: the geometric mean of the ratios of new to old cost of the changed figures; above 1 is worse.
  std::map<std::string, double> ratios;
};

/// A file of figures to compare with, kept beside the source: schema ccdt.baseline/1.
struct Baseline {
  Recording recording;  ///< exact figures and instruction counts only
  std::vector<BaselineUpdate> history;
};

bool is_baseline(const bench::Json& json);

/// \throw InputError  it cannot be read or is invalid; names the JSON pointer
Baseline read_baseline(const std::filesystem::path& file);

/// Writes it with one sorted line for each group of figures, so that changes can be reviewed.
/// \throw OutputError
void write_baseline(const Baseline& baseline, const std::filesystem::path& file);

/// The baseline with the figures of `head` that the rules gate. Instruction counts stay if `head` has none.
///
/// \param figures  the result of comparing `old` with `head`
Baseline updated(const Baseline& old, const Recording& head, const Rules& rules,
                 const std::vector<JudgedFigure>& figures, const std::string& reason);

/// Notes on a history that only gets worse, with the reasons; empty if it does not.
std::vector<std::string> history_notes(const std::vector<BaselineUpdate>& history);

}  // namespace ccdt::gate
