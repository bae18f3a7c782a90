#include "tools/error_words.h"

#include <algorithm>
#include <filesystem>
#include <new>

#include "engine/base/digits.h"
#include "engine/base/errors.h"

namespace ccdt::tools {
namespace {

constexpr std::size_t most_shown = 10;  ///< facets or points; the others are only counted

template <class Type>
bool is(const std::exception& error) {
  return dynamic_cast<const Type*>(&error) != nullptr;
}

std::string head(const Place& place) {
  std::string text = "ccdt: ";
  if (!place.file.empty()) text += place.file + ":";
  if (place.line > 0) text += std::to_string(place.line) + ":";
  if (place.byte >= 0) text += "byte " + std::to_string(place.byte) + ":";
  if (text.back() == ':') text += " ";
  return text;
}

std::string the_rest(std::size_t count) {
  return count > most_shown ? " and " + std::to_string(count - most_shown) + " more" : "";
}

std::string body(const Place& place) {
  std::string text;
  if (!place.facets.empty()) {
    text += place.facets.size() == 1 ? "\n  facet" : "\n  facets";
    for (std::size_t i = 0; i < std::min(most_shown, place.facets.size()); ++i)
      text += (i == 0 ? " " : ", ") + std::to_string(place.facets[i]);
    text += the_rest(place.facets.size());
  }
  for (std::size_t i = 0; i < std::min(most_shown, place.points.size()); ++i) {
    const auto& [x, y, z] = place.points[i];
    text += "\n  at (" + digits(x) + ", " + digits(y) + ", " + digits(z) + ")";
  }
  if (place.points.size() > most_shown) text += "\n " + the_rest(place.points.size()) + " points";
  return text;
}

}  // namespace

std::string in_words(const std::exception& error) {
  if (const auto* known = dynamic_cast<const Error*>(&error)) {
    std::string text = head(known->place()) + known->what() + body(known->place());
    if (!known->remedy().empty()) text += "\n  " + known->remedy();
    return text;
  }
  if (is<std::bad_alloc>(error))
    return "ccdt: out of memory\n  use a larger --edge-length, or a machine with more memory";
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return "ccdt: " + file->path1().string() + ": " + file->code().message() +
           "\n  check the path and its write permissions";
  return "ccdt: internal error: " + std::string(error.what()) +
         "\n  this is a bug in ccdt: please report it with the input";
}

ExitCode exit_code_of(const std::exception& error) {
  if (is<InputError>(error) || is<OutputError>(error) || is<std::filesystem::filesystem_error>(error)) return bad_input;
  if (is<LimitError>(error) || is<std::bad_alloc>(error)) return limit_reached;
  return failed_a_check;
}

}  // namespace ccdt::tools
