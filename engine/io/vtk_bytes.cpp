#include "engine/io/vtk_bytes.h"

#include <zlib.h>

#include <array>

namespace ccdt::io {

namespace {

// Level 1 is three times as fast as zlib's default, and a mesh gets hardly larger.
constexpr int fast = 1;

}  // namespace

std::optional<std::string> decode_base64(std::string_view text) {
  static constexpr std::uint8_t bad = 255, padding = 254, blank = 253;
  static constexpr auto table = [] {
    std::array<std::uint8_t, 256> values{};
    values.fill(bad);
    std::uint8_t next = 0;
    for (const char c : std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"))
      values[static_cast<unsigned char>(c)] = next++;
    for (const char c : {' ', '\t', '\r', '\n'}) values[static_cast<unsigned char>(c)] = blank;
    values['='] = padding;
    return values;
  }();
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
  return digits == 0 ? std::optional(std::move(bytes)) : std::nullopt;
}

void CompressedBlocks::compress_block(std::size_t bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes));
  const std::size_t begin = compressed_.size();
  compressed_.resize(begin + size);
  if (compress2(reinterpret_cast<Bytef*>(compressed_.data() + begin), &size,
                reinterpret_cast<const Bytef*>(block_.data()), static_cast<uLong>(bytes), fast) != Z_OK)
    throw std::bad_alloc();  // nothing else can go wrong where there is room enough
  compressed_.resize(begin + size);
  sizes_.push_back(size);
  block_.erase(0, bytes);
}

std::string CompressedBlocks::finish() {
  const std::uint64_t last = block_.size();
  if (last > 0) compress_block(last);
  std::vector<std::uint64_t> head = {sizes_.size(), block_size, last};
  head.insert(head.end(), sizes_.begin(), sizes_.end());
  return std::string(reinterpret_cast<const char*>(head.data()), head.size() * sizeof head[0]) + compressed_;
}

std::optional<std::string> decompress_block(std::string_view compressed, std::size_t size) {
  constexpr std::size_t largest_ratio = 1032;  // of zlib; asked before memory is taken
  if (size / largest_ratio > compressed.size()) return std::nullopt;
  std::string bytes(size, '\0');
  uLongf found = static_cast<uLongf>(size);
  const int status =
      uncompress(reinterpret_cast<Bytef*>(bytes.data()), &found, reinterpret_cast<const Bytef*>(compressed.data()),
                 static_cast<uLong>(compressed.size()));
  return status == Z_OK && found == size ? std::optional(std::move(bytes)) : std::nullopt;
}

}  // namespace ccdt::io
