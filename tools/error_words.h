#pragma once

#include <exception>
#include <string>

namespace ccdt::tools {

/// The exit codes of the program, part of its interface.
enum ExitCode : int { done = 0, failed_a_check = 1, wrong_usage = 2, bad_input = 3, limit_reached = 4, undecided = 5 };

/// The message for an error, as every verb prints it: "ccdt: FILE:LINE: what", then the facets and points of the place,
/// then what to do; each on a line of its own.
std::string in_words(const std::exception& error);

/// The program's exit code for an error.
ExitCode exit_code_of(const std::exception& error);

}  // namespace ccdt::tools
