#pragma once

#include <string>

#include "bench/gate/verdict.h"

namespace ccdt::reports {

/// A verdict for a terminal: the verdict and the layers that were judged; one line for each figure that is worse,
/// undecided, not comparable, better or new, the worst first; the notes; and a table of all cases.
///
/// \param most_lines  lines for each kind of figure; the others are only counted
std::string to_terminal(const gate::Verdict& verdict, std::size_t most_lines = 40);

/// The same in Markdown, with all figures that are worse or undecided.
std::string to_markdown(const gate::Verdict& verdict);

}  // namespace ccdt::reports
