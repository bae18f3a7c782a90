#pragma once

#include <string>
#include <vector>

namespace ccdt {

/// A table of texts: the first row is the heading, the first column is aligned left and the others right. Rows may be
/// short.
using TextTable = std::vector<std::vector<std::string>>;

/// With columns aligned by spaces, for a terminal. A rule follows the heading.
std::string to_terminal(const TextTable& table);

/// In Markdown, with aligned columns so that the source can be read as well.
std::string to_markdown(const TextTable& table);

}  // namespace ccdt
