#pragma once

#include <map>
#include <string>

#include "bench/gate/paired_samples.h"
#include "bench/gate/timed_targets.h"

namespace ccdt::gate {

/// Cases that took these seconds.
inline Measured measured(const std::map<std::string, double>& seconds) {
  Measured all;
  for (const auto& [name, value] : seconds) all[name] = {.seconds = value, .timed_seconds = value};
  return all;
}

/// Samples of one program, before the first pair.
inline SampleSet start_samples(std::uint64_t seed) {
  SampleSet samples;
  samples.seed = seed;
  samples.base_program = samples.head_program = "one program";
  return samples;
}

}  // namespace ccdt::gate
