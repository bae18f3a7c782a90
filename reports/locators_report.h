#pragma once

#include <string>

#include "bench/experiments/locators.h"

namespace ccdt {

/// The locators for a terminal: seconds of the front with each, ratios, and whether they are as expected.
std::string to_terminal(const Locators& locators);

/// The same in Markdown, with the definitions and the machine.
std::string to_markdown(const Locators& locators);

}  // namespace ccdt
