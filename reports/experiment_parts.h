#pragma once

#include <string>
#include <vector>

#include "bench/experiments/experiment.h"

namespace ccdt {

/// How the numbers of an experiment came to be, in one sentence: "Medians of 5 runs in turn ...".
std::string how_measured(const Circumstances& how);

/// A Markdown section with a bullet a line; empty if there is no line.
std::string section(const std::string& title, const std::vector<std::string>& lines);

/// The same for a terminal.
std::string terminal_section(const std::string& title, const std::vector<std::string>& lines);

/// The Markdown sections that end every report: what the rows mean, and the machine.
std::string closing_sections(const std::vector<std::string>& definitions, const Circumstances& how);

/// "holds", or what else came of a claim, in words that fit behind "at most 1.1: ".
std::string claim_words(Claim claim);

}  // namespace ccdt
