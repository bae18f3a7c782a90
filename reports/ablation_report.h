#pragma once

#include <string>

#include "bench/experiments/ablation.h"

namespace ccdt {

/// What swaps, smoothing and both do, for a terminal: a table a surface.
std::string to_terminal(const Ablation& ablation);

/// The same in Markdown, with histograms, the definitions and the machine.
std::string to_markdown(const Ablation& ablation);

}  // namespace ccdt
