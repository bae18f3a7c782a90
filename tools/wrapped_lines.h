#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace ccdt::tools {

/// The width of the terminal of a file descriptor in characters: COLUMNS, if that is set, or what the terminal says; 80
/// if it is no terminal.
int terminal_columns(int descriptor);

/// Breaks lines at spaces so that they have at most so many characters; a longer word stays whole. The rest of a line
/// begins below its text: a line "  name    meaning" continues below the meaning. Lines stay as they are if they begin
/// with a command, "  ccdt", which can then be copied, or if they are rows of a table.
///
/// \param begin  characters that are already in the first line
std::string wrapped(std::string_view text, int columns, std::size_t begin = 0);

}  // namespace ccdt::tools
