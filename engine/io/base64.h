#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ccdt::io {

/// Decodes base64. Padding may also stand in the middle, where two encoded pieces follow each other; blanks are
/// skipped. \return nothing if there is another character or a piece is incomplete
std::optional<std::string> decode_base64(std::string_view text);

}  // namespace ccdt::io
