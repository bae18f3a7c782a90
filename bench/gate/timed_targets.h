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

/// The measurements of one case in one run.
struct MeasuredCase {
  double seconds = 0;
  double timed_seconds = 0;                     ///< the span of time that the clock measured: all iterations
  std::map<std::string, double> counters = {};  ///< may be infinite or not a number
  std::string failure = {};                     ///< why the case failed though the program went on; empty: it did not
};

/// The measurements by the names of the cases.
using Measured = std::map<std::string, MeasuredCase>;

/// A process that times one or several cases.
struct TimedTarget {
  std::string name;    ///< for people
  std::string figure;  ///< what is timed: "seconds.mesh"
  /// Runs the process once. The result need not contain cases that are not wanted.
  /// \throw ProgramFailed
  /// \throw baselines::Stopped
  std::function<Measured(const RunRequest&)> run = {};
  std::function<std::string(Side, const std::string& case_name)> command = {};  ///< that repeats one run
  /// Lists the names of all cases without running them. No function or no names: the program cannot list them.
  std::function<std::vector<std::string>(Side)> list = {};
};

/// One target for each case of a sweep. Both programs are versions of `ccdt`. The rules name the figure: one of the
/// report, such as "seconds.mesh", or "wall", the time of the whole process.
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
