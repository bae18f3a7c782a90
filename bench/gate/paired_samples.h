#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/base/enum_names.h"

namespace ccdt::gate {

/// The share of the ratios that a trimmed mean drops at each end (Wilcox 2017, section 3.3).
inline constexpr double trimmed_share = 0.2;

/// Which of the two programs.
enum class Side { base, head };

constexpr auto names_of(Side) {
  return std::to_array<NamedValue<Side>>({{Side::base, "base"}, {Side::head, "head"}});
}

/// One run of each program, one right after the other.
struct Pair {
  double base = 0, head = 0;  ///< seconds
  bool head_first = false;
  int layout = 0;  ///< number of the build; the same for both programs

  bool operator==(const Pair&) const = default;
};

/// The values of a counter, one of each pair.
struct PairedCounter {
  std::vector<double> base, head;
};

/// Everything measured for one case. The confirmation has new times, not those of the screening.
struct PairedSamples {
  std::string case_name;
  std::string figure;        ///< "seconds.mesh", "real_time", "wall"
  std::string base_command;  ///< the command that repeats one run
  std::string head_command;
  std::vector<Pair> screening;
  std::vector<Pair> confirmation;                   ///< empty if the case was not a suspect
  bool in_base_only = false, in_head_only = false;  ///< then there are no pairs
  std::string base_failure, head_failure;           ///< why a program failed on it; empty: it did not
  double timed_seconds = 0;                         ///< the shortest span of time that the clock measured
  std::map<std::string, PairedCounter> counters = {};

  bool has_failed() const { return !base_failure.empty() || !head_failure.empty(); }
  bool is_comparable() const { return !in_base_only && !in_head_only && !has_failed(); }
};

/// The raw times of a gate, from which its verdict can be computed again: schema ccdt.samples/1.
struct SampleSet {
  std::uint64_t seed = 0;  ///< seed of the order in pairs, the padding, and the bootstrap
  std::vector<PairedSamples> cases;
  double clock_seconds = 0;                          ///< the smallest step of the clock
  bool is_rebuilt = false;                           ///< each layout is a build of its own
  std::string base_program = {}, head_program = {};  ///< hash of the file, and the arguments
  bool is_finished = false;                          ///< all cases are decided, or no more pairs are allowed

  bool is_same_program() const { return base_program == head_program && !base_program.empty(); }
};

/// The times of one side.
std::vector<double> seconds_of(std::span<const Pair> pairs, Side side);

/// log(head / base) of each pair.
std::vector<double> log_ratios(std::span<const Pair> pairs);

/// Writes the file whole or not at all. \throw OutputError
void write_samples(const SampleSet& samples, const std::filesystem::path& file);

/// \throw InputError  it cannot be read, or is not JSON of that schema
SampleSet read_samples(const std::filesystem::path& file);

}  // namespace ccdt::gate
