#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "baselines/external_program.h"

namespace ccdt {

/// Of a program that does not say it.
inline constexpr const char* unknown_version = "unknown";

/// The last lines of what a program has printed, without empty ones, joined by " | ".
std::string last_words(const std::filesystem::path& log);

/// The sum of the numbers that the first group of a regular expression (ECMAScript) matches, over the lines of a log.
/// None if no line matches.
std::optional<double> sum_in_log(const std::filesystem::path& log, const std::string& pattern);

/// Runs a program that prints its version.
/// \param pattern  ECMAScript: of the first line that matches, the first group or all that matches; empty: the first
///                 line that is not empty
/// \return  `unknown_version` if the program cannot be run, or no line matches
std::string version_of_program(const std::vector<std::string>& command, const std::string& pattern,
                               const ProgramSurroundings& surroundings = {});

}  // namespace ccdt
