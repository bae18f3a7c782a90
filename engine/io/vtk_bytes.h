#pragma once

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

/// Compresses bytes block by block with zlib, in the layout of VTK's arrays: the number of blocks, the size of a whole
/// block, the size of the last block if it is not whole (0 if it is), the compressed size of each block, the blocks.
class CompressedBlocks {
 public:
  static constexpr std::size_t block_size = std::size_t{1} << 17;

  /// Adds the bytes of a value as they are in memory.
  template <class T>
  void put(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    if (bytes_.size() >= most_waiting_) compress();
  }

  /// To be called once, after the last `put`.
  ///
  /// \return the bytes for the file: 64-bit numbers, then the blocks
  std::string finish();

 private:
  void compress();

  // As many blocks are collected as keep all threads busy.
  const std::size_t most_waiting_ = block_size * (thread_count() == 1 ? 1 : 4 * thread_count());
  std::string bytes_, compressed_;
  std::vector<std::uint64_t> sizes_;
};

/// May this many compressed bytes hold a block of this size? To be checked before memory is allocated.
bool may_hold(std::uint64_t compressed, std::uint64_t size);

/// Decompresses a block.
///
/// \param bytes  gets the contents, which must have exactly this size
/// \return       false if it is no zlib block of this size
bool decompress_block(std::string_view compressed, std::span<char> bytes);

}  // namespace ccdt::io
