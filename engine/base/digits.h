#pragma once

#include <array>
#include <charconv>
#include <string>

namespace ccdt {

/// The shortest digits that read back bit for bit.
inline std::string digits(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace ccdt
