#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/run/json.h"

namespace ccdt::bench {

/// The environment of a run, needed to understand its times later.
struct Environment {
  std::string cpu;                 ///< model name
  unsigned cores = 0;              ///< that this process may use
  std::uint64_t memory_bytes = 0;  ///< of the machine
  double load_average = 0;         ///< over the last minute, before the run
  std::string governor;            ///< clock governor of the first core; empty if unknown
  /// The temperature of the hottest sensor of the processor or its surroundings, before the run; none if no sensor can
  /// be read.
  std::optional<double> temperature_celsius;
  std::optional<int> jobs;  ///< number of simultaneous cases, if known
  std::string system;       ///< kernel and its release
  std::string compiler, flags, build_type;
  std::string revision;                          ///< of the source, "unknown" outside a git checkout
  std::map<std::string, std::string> libraries;  ///< versions
};

Environment capture_environment();

/// The highest temperature of all thermal zones and processor sensors below a folder such as /sys/class. None if no
/// sensor can be read.
std::optional<double> hottest_celsius(const std::filesystem::path& folder);

void to_json(Json& json, const Environment& environment);
/// \throw nlohmann::json::exception  names are missing or of another type
void from_json(const Json& json, Environment& environment);

/// The command line of this process, its program by its bare name: {"ccdt", "mesh", "part.stl", ...}.
std::vector<std::string> command_line();

/// The largest resident memory so far of this process, or of a child that it has waited for. Unlike the value of
/// getrusage, it starts at 0 after exec, so a program is not charged for the memory of its parent.
std::uint64_t peak_rss_bytes();

/// SHA-256 of a file's bytes, 64 lowercase hexadecimal digits; empty if it cannot be read or is no regular file.
std::string sha256_of_file(const std::filesystem::path& file);
/// SHA-256 of the bytes of a text.
std::string sha256_of_text(std::string_view text);

}  // namespace ccdt::bench
