#pragma once

#include <vector>

#include "bench/gate/recording.h"
#include "bench/gate/rules.h"
#include "bench/gate/verdict.h"

namespace ccdt::gate {

/// Compares the recordings of two programs: exact figures always, instruction counts if they were made under the same
/// conditions, times never. If the recordings have no case in common, nothing is compared.
///
/// \param recorded  the base
std::vector<JudgedFigure> compare_recordings(const Recording& recorded, const Recording& head, const Rules& rules);

/// Compares the exact figures only. A counter that is a whole number in the base must stay the same. Any other counter
/// is judged if a rule names it (`has_rule`), and is otherwise listed as not gated.
std::vector<JudgedFigure> compare_exact(const Recording& base, const Recording& head, const Rules& rules);

/// Compares the instruction counts only.
std::vector<JudgedFigure> compare_instructions(const Recording& base, const Recording& head, const Rules& rules);

/// The first condition of instruction counts in which the recordings differ, with both values; empty if they agree.
std::string other_conditions(const Recording& base, const Recording& head);

/// The verdict on a case that only the base has: worse, unless the rules allow it.
JudgedFigure lost_case(const CaseFigures& one, Layer layer, const Rules& rules);

/// A case that only the head has. There is nothing to compare it with.
JudgedFigure added_case(const CaseFigures& one, Layer layer);

}  // namespace ccdt::gate
