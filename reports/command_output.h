#pragma once

#include <string>

#include "bench/run_record.h"
#include "bench/verify/verify.h"

namespace ccdt {

/// What a person wants to know after a mesh: counts, Steiner vertices, seconds by stage and the worst quality; a few
/// lines.
std::string summarize(const RunRecord& record);

/// The result of `ccdt verify`: one line a check, with the first failures under it, and the volumes.
std::string to_terminal(const Verification& verification);

/// As JSON of schema `ccdt.verify/1`.
std::string to_json(const Verification& verification, const std::string& input, const std::string& mesh);

}  // namespace ccdt
