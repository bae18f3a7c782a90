#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/json.h"

namespace ccdt::bench {

/// Where and with what a run was made: what is needed to understand its times later.
struct Environment {
  std::string cpu;                 ///< model name
  unsigned cores = 0;              ///< that this process may use
  std::uint64_t memory_bytes = 0;  ///< of the machine
  double load_average = 0;         ///< over the last minute, before the run
  std::string governor;            ///< of the clock of the first core; empty if the system does not say it
  /// Of the hottest sensor of the processor or its surroundings, before the run; none if there is none to read.
  std::optional<double> temperature_celsius;
  std::optional<int> jobs;  ///< how many cases ran at the same time, if a runner has said so
  std::string system;       ///< kernel and its release
  std::string compiler, flags, build_type;
  std::string revision;                          ///< of the source, "unknown" outside a git checkout
  std::map<std::string, std::string> libraries;  ///< versions
};

Environment capture_environment();

/// What the sensors below a folder as /sys/class say: the highest of all thermal zones and of the sensors that measure
/// a processor. None if none can be read.
std::optional<double> hottest_celsius(const std::filesystem::path& folder);

void to_json(Json& json, const Environment& environment);
/// \throw nlohmann::json::exception  names are missing or of another type
void from_json(const Json& json, Environment& environment);

/// The command line of this process, its program by its bare name: {"ccdt", "mesh", "part.stl", ...}.
std::vector<std::string> command_line();

/// The largest resident memory so far of this process, or of a child that it has waited for. Unlike getrusage's, its
/// own starts anew at exec: a program is not blamed for the memory of the one that started it.
std::uint64_t peak_rss_bytes();

/// SHA-256 of a file's bytes, 64 lowercase hexadecimal digits; empty if the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);
/// Of the bytes of a text.
std::string sha256_of_text(std::string_view text);

}  // namespace ccdt::bench
