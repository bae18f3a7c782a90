#pragma once

#include <string>

#include "bench/experiments/fig8.h"

namespace ccdt {

/// Fig. 8 for a terminal: sizes and seconds of each strategy, then how they grow and whether that is as we claim.
std::string to_terminal(const Fig8& fig8);

/// The same in Markdown, with the definitions and the machine.
std::string to_markdown(const Fig8& fig8);

}  // namespace ccdt
