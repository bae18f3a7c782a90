#pragma once

#include <string>
#include <string_view>

namespace ccdt::io {

/// A text for an attribute of XML. Control characters and bytes that are not UTF-8, which no XML may contain, become
/// '_'.
std::string xml_text(std::string_view text);

}  // namespace ccdt::io
