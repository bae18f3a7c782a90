#pragma once

#include <string>

#include "bench/experiments/interior_points.h"

namespace ccdt {

/// The interior points for a terminal: how many were placed and dropped, where, and what that says about the paper's
/// claim.
std::string to_terminal(const InteriorPoints& points);

/// The same in Markdown, with the definitions and the machine.
std::string to_markdown(const InteriorPoints& points);

}  // namespace ccdt
