#include "engine/io/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <climits>
#include <utility>

namespace ccdt::io {
namespace {

/// zlib's state, freed at the end.
class Inflater {
 public:
  explicit Inflater(const FileBytes& file) : file_(file) {
    constexpr int gzip_format = 16;
    if (inflateInit2(&state_, gzip_format + MAX_WBITS) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&state_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// A file may have several members, one after the other.
  std::string inflate_all() {
    std::string bytes;
    std::size_t size = 0;
    const std::size_t most = largest_inflation * file_.bytes.size();
    bool is_whole = false;
    while (position_ < file_.bytes.size() || !is_whole) {
      if (size == bytes.size()) {
        if (size == most)
          fail("it is more than " + std::to_string(largest_inflation) + " times as large when inflated",
               "inflate it with gunzip if you trust it");
        bytes.resize(std::min(most, std::max(2 * size, 4 * file_.bytes.size())));
      }
      is_whole = inflate_some(bytes, size);
    }
    if (size == 0) fail("there is nothing in it", "compress the file again");
    bytes.resize(size);
    return bytes;
  }

 private:
  /// \return  is this the end of a member?
  bool inflate_some(std::string& bytes, std::size_t& size) {
    const std::string& packed = file_.bytes;
    state_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + position_));
    state_.avail_in = static_cast<uInt>(std::min<std::size_t>(packed.size() - position_, UINT_MAX));
    state_.next_out = reinterpret_cast<Bytef*>(bytes.data() + size);
    state_.avail_out = static_cast<uInt>(std::min<std::size_t>(bytes.size() - size, UINT_MAX));
    const uInt in = state_.avail_in, out = state_.avail_out;
    const int status = inflate(&state_, Z_NO_FLUSH);
    position_ += in - state_.avail_in;
    size += out - state_.avail_out;
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status == Z_STREAM_END) return inflateReset(&state_) == Z_OK;
    if (status != Z_OK) fail("its compressed data are damaged or truncated", "compress the file again");
    return false;
  }

  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    fail_at_byte(file_, position_, what, remedy);
  }

  const FileBytes& file_;
  z_stream state_ = {};
  std::size_t position_ = 0;  ///< in the compressed file
};

}  // namespace

bool is_gzip_name(const std::filesystem::path& file) {
  return lower_ending(file) == ".gz";
}

std::filesystem::path without_gzip(const std::filesystem::path& file) {
  return is_gzip_name(file) ? std::filesystem::path(file).replace_extension() : file;
}

FileBytes read_inflated_file(const std::filesystem::path& file) {
  FileBytes given = read_whole_file(file);
  if (is_gzip_name(file)) given.bytes = Inflater(given).inflate_all();
  return given;
}

}  // namespace ccdt::io
