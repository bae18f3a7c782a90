#pragma once

#include <string>

#include "bench/experiments/lattice_fit.h"

namespace ccdt {

/// The settings for a terminal: what each comes to over all surfaces, which is the best, and whether that is the
/// default.
std::string to_terminal(const LatticeFit& fit);

/// The same in Markdown, with the surfaces, the definitions and the machine.
std::string to_markdown(const LatticeFit& fit);

}  // namespace ccdt
