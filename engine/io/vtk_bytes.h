#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ccdt::io {

/// Decodes base64. Padding may also stand in the middle, where two encoded pieces follow each other; blanks are
/// skipped.
///
/// \return nothing if there is another character or a piece is incomplete
std::optional<std::string> decode_base64(std::string_view text);

/// Bytes that zlib compresses block by block, as VTK's arrays are: the number of blocks, the size of a whole block, the
/// size of the last block if it is not whole (0 if it is), the compressed size of each block, the blocks.
class CompressedBlocks {
 public:
  static constexpr std::size_t block_size = std::size_t{1} << 17;

  /// Adds the bytes of a value as they are in memory.
  template <class T>
  void put(const T& value) {
    block_.append(reinterpret_cast<const char*>(&value), sizeof value);
    if (block_.size() >= block_size) compress_block(block_size);
  }

  /// To be called once, when all is put. \return what the file has: numbers of 64 bits, and the blocks
  std::string finish();

 private:
  void compress_block(std::size_t bytes);

  std::string block_, compressed_;
  std::vector<std::uint64_t> sizes_;
};

/// Decompresses a block.
///
/// \param size  which it should have then
/// \return      nothing if it is no zlib block of this size
std::optional<std::string> decompress_block(std::string_view compressed, std::size_t size);

}  // namespace ccdt::io
