#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "baselines/process.h"
#include "bench/cases/case.h"
#include "bench/gate/paired_samples.h"
#include "bench/gate/rules.h"
#include "engine/base/errors.h"

namespace ccdt::gate {

/// A program failed while its time was measured.
class ProgramFailed : public MeshError {
 public:
  ProgramFailed(Side side, const std::string& what, Place place, std::string command)
      : MeshError(what, std::move(place), "run it alone: " + command), side_(side), command_(std::move(command)) {}

  Side side() const { return side_; }
  const std::string& command() const { return command_; }

 private:
  Side side_;
  std::string command_;
};

/// One run of a target.
struct RunRequest {
  Side side = Side::base;
  std::size_t padding = 0;           ///< bytes of a variable that shifts the stack of the process
  std::set<std::string> cases = {};  ///< wanted cases; empty: all
};

/// A process that times one or several cases.
struct TimedTarget {
  std::string name;    ///< for people
  std::string figure;  ///< what is timed: "seconds.mesh"
  /// Seconds by case. Cases that are not wanted may be missing.
  /// \throw ProgramFailed
  /// \throw baselines::Stopped
  std::function<std::map<std::string, double>(const RunRequest&)> run = {};
  std::function<std::string(Side, const std::string& case_name)> command = {};  ///< that repeats one run
};

/// Two programs, which may be the same.
struct Programs {
  std::filesystem::path base, head;
};

/// One target for each case of a sweep; the programs are `ccdt`s. The figure is that of the rules: "seconds.mesh" or
/// another of the report, or "wall", the time of the whole process.
///
/// \param cases   with inputs that exist; their options are passed on
/// \param folder  for scratch files; exists
std::vector<TimedTarget> sweep_targets(const Programs& programs, std::span<const cases::Case> cases, const Rules& rules,
                                       const std::filesystem::path& folder);

/// Two programs on Google Benchmark. Each benchmark name is a case, and its real time the figure.
///
/// \param arguments  for both programs; they override the defaults, one repetition of 0.05 s
TimedTarget benchmark_target(const Programs& programs, const std::vector<std::string>& arguments,
                             const baselines::Limits& limits, const std::filesystem::path& folder);

/// Two programs of any kind, whose whole processes are timed. There is one case: the arguments.
TimedTarget command_target(const Programs& programs, const std::vector<std::string>& arguments,
                           const baselines::Limits& limits);

}  // namespace ccdt::gate
