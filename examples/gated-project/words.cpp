#include "words.h"

#include <algorithm>

namespace words {
namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

}  // namespace

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> found;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && is_letter(text[end])) ++end;
    if (end > i) found.push_back(text.substr(i, end - i));
    i = end + 1;
  }
  return found;
}

std::vector<std::string_view> vocabulary(std::vector<std::string_view> all, std::int64_t& comparisons) {
  std::sort(all.begin(), all.end(), [&](std::string_view a, std::string_view b) {
    ++comparisons;
    return a < b;
  });
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool contains(const std::vector<std::string_view>& vocabulary, std::string_view word, std::int64_t& comparisons) {
  std::size_t first = 0;
  std::size_t last = vocabulary.size();
  while (first < last) {
    const std::size_t middle = first + (last - first) / 2;
    ++comparisons;
    const int order = vocabulary[middle].compare(word);
    if (order == 0) return true;
    if (order < 0)
      first = middle + 1;
    else
      last = middle;
  }
  return false;
}

}  // namespace words
