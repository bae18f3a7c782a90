#include "baselines/placeholders.h"

#include <algorithm>

namespace ccdt {
namespace {

constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz_";

/// The next placeholder from a position on, without its braces; empty, at the end of the text, if there is none.
std::string_view next_name(std::string_view text, std::size_t from) {
  for (std::size_t brace = text.find('{', from); brace != std::string_view::npos; brace = text.find('{', brace + 1)) {
    const std::size_t end = std::min(text.find_first_not_of(letters, brace + 1), text.size());
    if (end > brace + 1 && end < text.size() && text[end] == '}') return text.substr(brace + 1, end - brace - 1);
  }
  return text.substr(text.size());
}

}  // namespace

const std::vector<std::string>& placeholder_names() {
  static const std::vector<std::string> names = {"input", "stem", "folder", "here", "edge_length", "max_volume"};
  return names;
}

std::vector<std::string> placeholders_in(std::string_view text) {
  std::vector<std::string> names;
  for (std::string_view name = next_name(text, 0); !name.empty();
       name = next_name(text, static_cast<std::size_t>(name.data() - text.data()) + name.size()))
    names.emplace_back(name);
  return names;
}

std::string filled(std::string_view text, const std::vector<Placeholder>& values) {
  std::string result;
  std::size_t done = 0;
  for (std::string_view name = next_name(text, 0); !name.empty(); name = next_name(text, done)) {
    const auto begin = static_cast<std::size_t>(name.data() - text.data());
    const auto known = std::ranges::find(values, name, &Placeholder::name);
    const std::size_t end = begin + name.size() + 1;
    result += text.substr(done, begin - 1 - done);
    result += known == values.end() ? std::string(text.substr(begin - 1, end - begin + 1)) : known->value;
    done = end;
  }
  return result.append(text.substr(done));
}

}  // namespace ccdt
