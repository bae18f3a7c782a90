#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/base/enum_names.h"

namespace ccdt::gate {

/// Which of the two programs.
enum class Side { base, head };

constexpr auto names_of(Side) {
  return std::to_array<NamedValue<Side>>({{Side::base, "base"}, {Side::head, "head"}});
}

/// Both programs once, one right after the other.
struct Pair {
  double base = 0, head = 0;  ///< seconds
  bool head_first = false;

  bool operator==(const Pair&) const = default;
};

/// All times of one figure of one case. Those of the confirmation are fresh.
struct PairedSamples {
  std::string case_name;
  std::string figure;        ///< "seconds.mesh", "real_time", "wall"
  std::string base_command;  ///< the command that repeats one run
  std::string head_command;
  std::vector<Pair> screening;
  std::vector<Pair> confirmation;                   ///< empty if the case was not a suspect
  bool in_base_only = false, in_head_only = false;  ///< then there are no pairs
};

/// The raw times of a gate, from which its verdict can be computed again: schema ccdt.samples/1.
struct SampleSet {
  std::uint64_t seed = 0;  ///< seed of the order in pairs, the padding, and the bootstrap
  std::vector<PairedSamples> cases;
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
