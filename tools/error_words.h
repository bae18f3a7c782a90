#pragma once

#include <exception>
#include <string>

#include "tools/exit_codes.h"

namespace ccdt {

/// An error in words, the way that every error of the program is told: "ccdt: FILE:LINE: what", then the facets and
/// points of the place, then what to do, a line each.
std::string in_words(const std::exception& error);

/// The program's exit code for an error.
ExitCode exit_code_of(const std::exception& error);

}  // namespace ccdt
