#pragma once

#include <string>

#include "bench/experiments/table1.h"

namespace ccdt {

/// Table 1 for a terminal: our seconds with their intervals and the paper's beside, the ratios, and why rows are empty.
std::string to_terminal(const Table1& table);

/// The same in Markdown, with the definitions and the machine.
std::string to_markdown(const Table1& table);

}  // namespace ccdt
