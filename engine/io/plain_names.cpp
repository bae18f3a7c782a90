#include "engine/io/plain_names.h"

#include <algorithm>
#include <utility>

namespace ccdt::io {
namespace {

constexpr bool is_plain_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

constexpr char upper_case(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

}  // namespace

std::string PlainNames::name_of(int marker, const std::string& prefix, const std::map<int, std::string>& names) {
  constexpr std::size_t most = 56;  // leaves room for a prefix and a number
  const auto given = names.find(marker);
  std::string name = given == names.end() ? std::to_string(marker) : given->second.substr(0, most);
  if (name.empty() || !is_plain_letter(name[0])) name = prefix + name;
  std::ranges::replace_if(
      name, [](char c) { return !is_plain_letter(c) && (c < '0' || c > '9'); }, '_');
  const auto is_new = [&] {
    std::string key = name;
    std::ranges::transform(key, key.begin(), upper_case);
    return used_.insert(std::move(key)).second;
  };
  // Another name may have become the same one.
  for (const std::string stem = name; !is_new();) name = stem + "_" + std::to_string(++next_);
  return name;
}

}  // namespace ccdt::io
