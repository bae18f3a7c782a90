#include "engine/io/vtk_bytes.h"

#include <zlib.h>

#include <array>
#include <utility>

namespace ccdt::io {

namespace {

// Level 1 is three times as fast as zlib's default, and the file is hardly larger.
constexpr int fast = 1;

}  // namespace

std::string compress_block(std::span<const std::byte> bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string block(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(block.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), fast) != Z_OK)
    throw std::bad_alloc();  // nothing else can go wrong if there is enough room
  block.resize(size);
  return block;
}

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

std::string join_blocks(std::span<const std::string> blocks, std::size_t size) {
  std::vector<std::uint64_t> head = {blocks.size(), block_size, size % block_size};
  for (const std::string& block : blocks) head.push_back(block.size());
  std::string bytes(reinterpret_cast<const char*>(head.data()), head.size() * sizeof head[0]);
  for (const std::string& block : blocks) bytes += block;
  return bytes;
}

bool may_hold(std::uint64_t compressed, std::uint64_t size) {
  constexpr std::uint64_t largest_ratio = 1032;  // of zlib
  return size / largest_ratio <= compressed;
}

bool decompress_block(std::string_view compressed, std::span<char> bytes) {
  uLongf found = static_cast<uLongf>(bytes.size());
  const int status =
      uncompress(reinterpret_cast<Bytef*>(bytes.data()), &found, reinterpret_cast<const Bytef*>(compressed.data()),
                 static_cast<uLong>(compressed.size()));
  if (status == Z_MEM_ERROR) throw std::bad_alloc();
  return status == Z_OK && found == bytes.size();
}

}  // namespace ccdt::io
