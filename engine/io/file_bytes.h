#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/errors.h"

namespace ccdt::io {

/// A whole file in memory.
struct FileBytes {
  std::string name;  ///< path as the user gave it
  std::string bytes;
};

bool is_there(const std::filesystem::path& file);

/// \throw InputError  no such file, a directory or another thing that is no file
void check_is_file(const std::filesystem::path& file);

/// Reads a whole file.
///
/// \throw InputError  no such file, a directory or another thing that is no file, empty, unreadable
/// \throw LimitError  it does not fit into memory
FileBytes read_whole_file(const std::filesystem::path& file);

/// The ending of a file's name in lower case, with its dot.
std::string lower_ending(const std::filesystem::path& file);

/// A place that is only known to be in a file.
inline Place place_in(std::string file) {
  return {.file = std::move(file)};
}

/// The place of the line of a text in which a byte is.
Place line_of_byte(const FileBytes& file, std::size_t byte);

/// Throws an InputError at an offset of a binary file.
[[noreturn]] void fail_at_byte(const FileBytes& file, std::size_t byte, const std::string& what,
                               const std::string& remedy, std::vector<long long> facets = {});

/// A number in binary.
template <class Number>
Number number_at(const char* bytes, bool big_endian = false) {
  static_assert(std::endian::native == std::endian::little);
  char digits[sizeof(Number)];
  std::memcpy(digits, bytes, sizeof digits);
  if (big_endian) std::reverse(digits, digits + sizeof digits);
  return std::bit_cast<Number>(digits);
}

}  // namespace ccdt::io
