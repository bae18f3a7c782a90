#include "engine/io/base64.h"

#include <array>
#include <cstdint>

namespace ccdt::io {

namespace {

constexpr std::uint8_t bad = 255, padding = 254, blank = 253;

constexpr std::array<std::uint8_t, 256> make_table() {
  std::array<std::uint8_t, 256> table{};
  for (auto& entry : table) entry = bad;
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < digits.size(); ++i)
    table[static_cast<unsigned char>(digits[i])] = static_cast<std::uint8_t>(i);
  for (const char c : {' ', '\t', '\r', '\n'}) table[static_cast<unsigned char>(c)] = blank;
  table['='] = padding;
  return table;
}

constexpr std::array<std::uint8_t, 256> table = make_table();

}  // namespace

std::optional<std::string> decode_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int digits = 0, padded = 0;
  for (const char c : text) {
    const std::uint8_t value = table[static_cast<unsigned char>(c)];
    if (value == blank) continue;
    if (value == bad || (value == padding && digits < 2) || (value != padding && padded > 0)) return std::nullopt;
    padded += value == padding;
    bits = bits << 6 | (value == padding ? 0u : value);
    if (++digits < 4) continue;
    for (int k = 0; k < 3 - padded; ++k) bytes += static_cast<char>(bits >> (16 - 8 * k) & 255);
    bits = 0;
    digits = padded = 0;
  }
  if (digits != 0) return std::nullopt;
  return bytes;
}

}  // namespace ccdt::io
