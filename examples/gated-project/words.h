#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace words {

/// The words of a text, in their order: its longest runs of letters.
std::vector<std::string_view> split(std::string_view text);

/// Sorts words and leaves one of each. Adds to `comparisons` how often two words were compared.
std::vector<std::string_view> vocabulary(std::vector<std::string_view> all, std::int64_t& comparisons);

/// Is the word in a vocabulary? Adds to `comparisons` how often two words were compared.
bool contains(const std::vector<std::string_view>& vocabulary, std::string_view word, std::int64_t& comparisons);

}  // namespace words
