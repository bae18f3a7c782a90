#pragma once

#include <string>
#include <vector>

#include "bench/experiments/table1.h"

namespace ccdt {

/// The paper lets every face go through the front at more than this many times the cost of Delaunay; so should we.
inline constexpr double least_gain = 8;

/// Where our ratios differ from those of the paper's Table 1, and why, a sentence each, as measured.
std::vector<std::string> table1_differences(const Table1& table);

}  // namespace ccdt
