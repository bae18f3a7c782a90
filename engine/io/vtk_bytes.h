#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/parallel.h"

namespace ccdt::io {

/// Decodes base64. Padding may also occur in the middle, where one encoded piece ends and the next begins; blanks are
/// skipped.
///
/// \return nothing if there is another character or a piece is incomplete
std::optional<std::string> decode_base64(std::string_view text);

/// The size of the blocks that we write.
inline constexpr std::size_t block_size = std::size_t{1} << 17;

/// Compresses a block with zlib.
std::string compress_block(std::span<const std::byte> bytes);

/// The layout of VTK's arrays: the number of blocks, the size of a whole block, the size of the last block if it is not
/// whole (0 if it is), the compressed size of each block, as 64-bit numbers; then the blocks.
///
/// \param size  of all bytes before they were compressed
std::string join_blocks(std::span<const std::string> blocks, std::size_t size);

/// Compresses the values `value_at(i)` for each i below `count`, as they are in memory, on several threads.
///
/// \return the bytes for the file
template <class ValueAt>
std::string compress_values(std::size_t count, const ValueAt& value_at) {
  using Value = decltype(value_at(count));
  const auto blocks = parallel_chunks(count, block_size / sizeof(Value), [&](std::size_t begin, std::size_t end) {
    std::vector<Value> values;
    values.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) values.push_back(value_at(i));
    return compress_block(std::as_bytes(std::span<const Value>(values)));
  });
  return join_blocks(blocks, count * sizeof(Value));
}

/// Can this many compressed bytes hold a block of this size? Check it before allocating memory.
bool may_hold(std::uint64_t compressed, std::uint64_t size);

/// Decompresses a block.
///
/// \param bytes  gets the contents, which must have exactly this size
/// \return       false if it is not a zlib block of this size
bool decompress_block(std::string_view compressed, std::span<char> bytes);

}  // namespace ccdt::io
