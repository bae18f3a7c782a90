#pragma once

#include <string>

#include "bench/run_record.h"

namespace ccdt {

/// What a person wants to know after a mesh: counts, Steiner vertices, seconds by stage and the worst quality; a few
/// lines.
std::string summarize(const RunRecord& record);

}  // namespace ccdt
