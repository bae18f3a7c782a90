#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/gate/paired_samples.h"
#include "bench/gate/rules.h"
#include "bench/run/identity.h"
#include "bench/run/statistics.h"
#include "engine/base/errors.h"

namespace ccdt::gate {

/// The noise of a case, from pairs of runs of one program.
struct CaseNoise {
  std::string case_name, figure;
  double seconds = 0;           ///< median
  double deviation = 0;         ///< standard deviation of log(second run / first run)
  double robust_deviation = 0;  ///< the same from the median absolute deviation
  double autocorrelation = 0;   ///< correlation of consecutive log ratios
  double noise_floor = 0;       ///< log ratio below which the interval of an unchanged program begins, in 99% of gates
  int pairs_needed = 0;         ///< pairs needed for an interval as narrow as the rules want
  std::optional<double> layout_deviation =
      {};                                     ///< standard deviation of log time between builds; none if there was one
  std::optional<double> smallest_found = {};  ///< slowdown that a gate finds with 95% probability: 0.03 is 3%; none if
                                              ///< it does not even find a doubled time
  std::vector<double> log_ratios;             ///< of all pairs, in order
};

/// The verdicts of a whole gate for an unchanged program, simulated with the measured pairs. The intervals are those of
/// Clopper and Pearson.
struct GateRates {
  int gates = 0;                 ///< simulated
  bench::Estimate false_alarms;  ///< share of gates
  bench::Estimate undecided;     ///< share of gates
};

/// The noise of this host: schema ccdt.calibration/1.
struct Calibration {
  std::string program;
  bench::Identity identity;  ///< of the machine
  std::uint64_t seed = 0;
  std::vector<CaseNoise> cases;
  GateRates rates;
};

/// The noise of a case; null if it is not in the calibration.
const CaseNoise* find_noise(const Calibration& calibration, const std::string& case_name);

/// Too few pairs for a calibration.
class TooFewSamples : public InputError {
 public:
  TooFewSamples(const std::string& what, int needed, std::string remedy)
      : InputError(what, {}, std::move(remedy)), needed_(needed) {}

  int needed() const { return needed_; }  ///< pairs of each case

 private:
  int needed_;
};

/// Rules that make a measurement take exactly this many pairs of each case, with the same program on both sides.
Rules rules_of_calibration(const Rules& rules, int pairs);

/// The calibration from the pairs; program and identity are left empty.
/// \throw TooFewSamples  says how many are needed
/// \throw InputError     the program failed on a case
Calibration calibrate(const SampleSet& samples, const Rules& rules);

/// For people: the noise of each case, the false-alarm rate of the whole gate, and the smallest slowdown that it finds.
std::string to_text(const Calibration& calibration);

/// Writes the file completely or not at all. \throw OutputError
void write_calibration(const Calibration& calibration, const std::filesystem::path& file);

/// \throw InputError  it cannot be read, or is not JSON of that schema
Calibration read_calibration(const std::filesystem::path& file);

}  // namespace ccdt::gate
