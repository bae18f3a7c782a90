#pragma once

#include <string>

#include "bench/verify/verify.h"

namespace ccdt {

/// One line a check, with the first failures under it, and the volumes.
std::string to_terminal(const Verification& verification);

/// As JSON of schema `ccdt.verify/1`.
std::string to_json(const Verification& verification, const std::string& input, const std::string& mesh);

}  // namespace ccdt
