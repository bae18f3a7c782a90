#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "baselines/stop.h"

namespace ccdt::baselines {

/// The path of an external program: the value of the environment variable, otherwise the first program of that name on
/// PATH. None if it is not an executable file.
std::optional<std::filesystem::path> find_program(const std::string& name, const char* environment_variable);

/// The first executable file of that name on PATH. None if there is none.
std::optional<std::filesystem::path> find_on_path(const std::string& name);

/// The version of a program that does not state it.
inline constexpr const char* unknown_version = "unknown";

/// Runs a program that prints its version.
///
/// \param pattern  ECMAScript, for the first matching line: its first group, or the whole match if it has none; empty:
///                 the first line that is not empty
/// \return         `unknown_version` if the program cannot be run, or no line matches
std::string version_of_program(const std::vector<std::string>& command, const std::string& pattern);

/// The last lines of what a program printed, without empty ones, joined by " | ".
std::string last_lines(std::istream& log);
std::string last_lines(const std::filesystem::path& log);

/// The first group of a regular expression (ECMAScript) in the first matching line of a log, or the whole match if
/// there is no group. None if no line matches.
std::optional<std::string> first_in_log(const std::filesystem::path& log, const std::string& pattern);

/// The sum, over all lines of a log, of the numbers in the first group of a regular expression (ECMAScript). None if no
/// line matches.
std::optional<double> sum_in_log(const std::filesystem::path& log, const std::string& pattern);

/// A new folder for temporary files, which is removed with its contents at the end. Until then, signals ask this
/// process to stop (`StopSignals`), so that they do not leave the folder behind.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  StopSignals signals_;
  std::filesystem::path path_;
};

}  // namespace ccdt::baselines
