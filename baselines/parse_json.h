#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

namespace ccdt::baselines {

/// The deepest nesting of lists and objects in JSON that this program reads. Schemas need fewer than ten levels, and
/// functions that visit a document call themselves once per level.
inline constexpr int most_nested = 200;

/// Parses untrusted text. The time and the memory grow with its length. Of members with equal names, the last one
/// counts.
///
/// \throw nlohmann::ordered_json::parse_error  it is not JSON, or is nested too deep; carries the byte
nlohmann::ordered_json parse_json(std::string_view text);

/// The same; none for a text that cannot be parsed.
std::optional<nlohmann::ordered_json> try_parse_json(std::string_view text);

}  // namespace ccdt::baselines
