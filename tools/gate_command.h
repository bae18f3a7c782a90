#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/gate/calibration.h"
#include "bench/gate/recording.h"
#include "bench/gate/rules.h"
#include "bench/gate/verdict.h"

/// The parts of `ccdt gate`.
namespace ccdt::tools {

/// The command line.
struct GateCommand {
  std::vector<std::string> words;  ///< CURRENT, or the arguments of the programs that are measured
  std::string against, rules, markdown, folder;
  std::string base, head;           ///< programs or commands
  std::string sweep, calibration;   ///< paths of files
  std::string rebuild;              ///< command that builds a program with another layout
  std::vector<gate::Layer> layers;  ///< override those of the rules; empty: no change
  std::optional<std::uint64_t> seed;
  int pairs = 100;          ///< pairs of runs of each case in a calibration
  int layouts = 0;          ///< overrides the rules; 0: no change
  double most_seconds = 0;  ///< of one run; 0: follows from the base
  bool shadow = false, update = false, calibrate = false, resume = false;
  std::string reason;

  bool measures() const { return !base.empty() || !head.empty(); }
};

/// The verdict, and the recording from which a new baseline is made.
struct GateResult {
  gate::Verdict verdict;
  gate::Recording head;
};

/// Is the baseline there, unless it is about to be written?
/// \throw InputError  no; says how to make one
void require_baseline(const GateCommand& command);

/// Measures the programs on this host, and compares them with each other or with the baseline.
///
/// \throw InputError          a program, the spec or the baseline cannot be read
/// \throw baselines::Stopped  the user has stopped the program; the times so far are in DIR/samples.json
GateResult measure(const GateCommand& command, const gate::Rules& rules);

/// Measures how noisy the base is on this host; writes DIR/calibration.json, and all times to DIR/samples.json.
///
/// \throw InputError          the program or the spec cannot be read, or there are too few pairs: says how many it
///                            needs
/// \throw baselines::Stopped  the user has stopped the program
gate::Calibration measure_calibration(const GateCommand& command, const gate::Rules& rules);

}  // namespace ccdt::tools
