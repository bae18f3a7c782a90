#pragma once

#include <vector>

#include "bench/gate/recording.h"
#include "bench/gate/rules.h"
#include "bench/gate/verdict.h"

namespace ccdt::gate {

/// Compares the recordings of two programs as far as possible: exact figures always, instruction counts if they were
/// made under the same conditions, times never.
///
/// \param recorded  the base
/// If two recordings have no case in common, nothing is compared.
std::vector<JudgedFigure> compare_recordings(const Recording& recorded, const Recording& head, const Rules& rules);

/// Compares the exact figures only.
std::vector<JudgedFigure> compare_exact(const Recording& base, const Recording& head, const Rules& rules);

/// Compares the instruction counts only.
std::vector<JudgedFigure> compare_instructions(const Recording& base, const Recording& head, const Rules& rules);

/// The first condition of instruction counts in which the recordings differ, with both values; empty if they agree.
std::string other_conditions(const Recording& base, const Recording& head);

/// Judges the commands of one recording whose runs did not take turns, with the first as the base: by the ratio of the
/// medians of independent samples.
std::vector<JudgedFigure> compare_commands(const Recording& recording, const Rules& rules);

}  // namespace ccdt::gate
