#pragma once

#include <string>

#include "bench/experiments/lattices.h"

namespace ccdt {

/// The lattices for a terminal: a table a surface, and whether the paper's claim that FCC is best is confirmed.
std::string to_terminal(const Lattices& lattices);

/// The same in Markdown, with histograms, the definitions and the machine.
std::string to_markdown(const Lattices& lattices);

}  // namespace ccdt
