#pragma once

#include <string>

#include "bench/run_record.h"
#include "bench/verify/verify.h"

namespace ccdt::reports {

/// What a person wants to know after a mesh: counts, Steiner vertices, seconds by stage and the worst quality; a few
/// lines.
std::string summarize(const bench::RunRecord& record);

/// The result of `ccdt verify`: one line a check, with the first failures under it, and the volumes.
std::string to_terminal(const verify::Verification& verification);

/// As JSON of schema `ccdt.verify/1`.
std::string to_json(const verify::Verification& verification, const std::string& input, const std::string& mesh);

}  // namespace ccdt::reports
