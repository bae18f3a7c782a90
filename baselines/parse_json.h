#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

namespace ccdt::baselines {

/// The deepest nesting of lists and objects in JSON that this program reads. Schemas need less than ten, and a function
/// that visits a document calls itself once for each level.
inline constexpr int most_nested = 200;

/// Parses a text that anyone may have written.
/// \throw nlohmann::ordered_json::parse_error  it is no JSON, or nested too deep; with the byte
nlohmann::ordered_json parse_json(std::string_view text);

/// The same; none for a text that cannot be parsed.
std::optional<nlohmann::ordered_json> try_parse_json(std::string_view text);

}  // namespace ccdt::baselines
