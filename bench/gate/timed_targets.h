#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "baselines/process.h"
#include "bench/gate/rules.h"
#include "bench/gate/side_program.h"
#include "bench/run/case.h"

namespace ccdt::gate {

/// What one run measured of one case.
struct MeasuredCase {
  double seconds = 0;
  double timed_seconds = 0;                     ///< the time that the clock measured at once: of all iterations
  std::map<std::string, double> counters = {};  ///< may be infinite or not a number
  std::string failure = {};                     ///< why the case failed though the program went on; empty: it did not
};

/// By the name of the case.
using Measured = std::map<std::string, MeasuredCase>;

/// A process that times one or several cases.
struct TimedTarget {
  std::string name;    ///< for people
  std::string figure;  ///< what is timed: "seconds.mesh"
  /// Cases that are not wanted may be missing.
  /// \throw ProgramFailed
  /// \throw baselines::Stopped
  std::function<Measured(const RunRequest&)> run = {};
  std::function<std::string(Side, const std::string& case_name)> command = {};  ///< that repeats one run
  /// The names of all cases, without running them. Empty, or without result: the program cannot tell.
  std::function<std::vector<std::string>(Side)> list = {};
};

/// One target for each case of a sweep; the programs are `ccdt`s. The figure is that of the rules: "seconds.mesh" or
/// another of the report, or "wall", the time of the whole process.
///
/// \param cases   with inputs that exist; their options are passed on
/// \param folder  for scratch files; exists
std::vector<TimedTarget> sweep_targets(const Programs& programs, std::span<const bench::Case> cases, const Rules& rules,
                                       const std::filesystem::path& folder);

/// Two programs of any kind, whose whole processes are timed. There is one case, named after the head.
///
/// \param arguments  for both programs
TimedTarget command_target(const Programs& programs, const Command& arguments, const baselines::Limits& limits);

}  // namespace ccdt::gate
