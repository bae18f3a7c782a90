#pragma once

#include <string>

namespace ccdt::results {

/// A text as a cell of CSV (RFC 4180). Spreadsheets take a text for a formula if it begins with one of = + - @ or a
/// control character; such a text, which may come from somebody else's file, gets an apostrophe before it.
std::string csv_text(const std::string& text);

}  // namespace ccdt::results
