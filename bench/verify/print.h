#pragma once

#include <string>
#include <vector>

#include "bench/verify/verify.h"

namespace ccdt {

/// A verification as lines for a terminal: one a check with its name and how many things were checked and failed, below
/// it the first failures; then the volumes and the verdict.
std::vector<std::string> describe(const Verification& verification);

}  // namespace ccdt
