#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ccdt::baselines {

/// Where an external program is: what the environment variable says, else the first of that name on PATH. None if that
/// is not a file that can be executed.
std::optional<std::filesystem::path> find_program(const std::string& name, const char* environment_variable);

/// The first file of that name on PATH that can be executed. None if there is none.
std::optional<std::filesystem::path> find_on_path(const std::string& name);

/// The version of a program that does not state it.
inline constexpr const char* unknown_version = "unknown";

/// Runs a program that prints its version.
/// \param pattern  ECMAScript: of the first line that matches, the first group or all that matches; empty: the first
///                 line that is not empty
/// \return  `unknown_version` if the program cannot be run, or no line matches
std::string version_of_program(const std::vector<std::string>& command, const std::string& pattern);

/// The last lines of what a program printed, without empty ones, joined by " | ".
std::string last_lines(std::istream& log);
std::string last_lines(const std::filesystem::path& log);

/// What the first group of a regular expression (ECMAScript), or where there is none all of it, matches in the first
/// line of a log that matches. None if no line matches.
std::optional<std::string> first_in_log(const std::filesystem::path& log, const std::string& pattern);

/// The sum of the numbers that the first group of a regular expression (ECMAScript) matches, over the lines of a log.
/// None if no line matches.
std::optional<double> sum_in_log(const std::filesystem::path& log, const std::string& pattern);

/// A new folder among the system's temporary files, which is removed with its contents at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace ccdt::baselines
