#include "baselines/parse_json.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace ccdt::baselines {
namespace {

void check_nesting(std::string_view text) {
  int depth = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_quoted) {
      if (c == '\\')
        ++i;
      else
        is_quoted = c != '"';
      continue;
    }
    is_quoted = c == '"';
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > most_nested)
      throw nlohmann::ordered_json::parse_error::create(
          101, i + 1, "nested deeper than " + std::to_string(most_nested) + " levels", nullptr);
  }
}

}  // namespace

nlohmann::ordered_json parse_json(std::string_view text) {
  check_nesting(text);
  return nlohmann::ordered_json::parse(text);
}

std::optional<nlohmann::ordered_json> try_parse_json(std::string_view text) {
  try {
    return parse_json(text);
  } catch (const nlohmann::ordered_json::parse_error&) {
    return std::nullopt;
  }
}

}  // namespace ccdt::baselines
