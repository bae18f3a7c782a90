#pragma once

#include <algorithm>
#include <bit>
#include <charconv>
#include <concepts>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/point.h"
#include "engine/io/unfinished_files.h"

namespace ccdt::io {

/// A whole file in memory.
struct FileBytes {
  std::string name;  ///< path as the user gave it
  std::string bytes;
};

/// A new hidden name in the same folder, for what will get the name of the target when it is complete.
std::filesystem::path temporary_beside(const std::filesystem::path& target);

bool is_there(const std::filesystem::path& file);

/// Does the file exist in the folder or below it, after following links?
bool is_within(const std::filesystem::path& folder, const std::filesystem::path& file);

/// Folders of results may come from somebody else, with links among the names that are read or written there.
///
/// \throw InputError  in the folder or in a folder in it, there is a link that leads out of it
void check_links_stay_within(const std::filesystem::path& folder);

/// \throw InputError  no such file, a folder, or not a regular file
void check_is_file(const std::filesystem::path& file);

/// \throw OutputError  a folder has the name of the file that will be written
void check_is_no_folder(const std::filesystem::path& file);

/// Reads a whole file.
///
/// \throw InputError  no such file, a folder, not a regular file, empty, or unreadable
/// \throw MemoryError
FileBytes read_whole_file(const std::filesystem::path& file);

/// The extension of a file's name in lower case, with its dot.
std::string lower_ending(const std::filesystem::path& file);

/// The place of an error if only the file is known.
inline Place place_in(std::string file) {
  return {.file = std::move(file)};
}

/// The line end of a text: a line feed, or a carriage return if there is no line feed at all.
char line_end_of(std::string_view text);

/// The place of the line of a text that contains a byte.
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

/// Text and numbers, in the shortest form that reads back bit for bit.
class TextBuffer {
 public:
  const std::string& bytes() const { return bytes_; }
  void reserve(std::size_t size) { bytes_.reserve(size); }
  void clear() { bytes_.clear(); }

  TextBuffer& operator<<(std::string_view text) {
    bytes_ += text;
    return *this;
  }
  TextBuffer& operator<<(const char* text) { return *this << std::string_view(text); }
  TextBuffer& operator<<(char c) {
    bytes_ += c;
    return *this;
  }
  template <class Number>
  requires(std::integral<Number> || std::same_as<Number, double>) TextBuffer& operator<<(Number value) {
    char digits[40];
    return *this << std::string_view(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
  TextBuffer& operator<<(const Point3& p) { return *this << p.x << ' ' << p.y << ' ' << p.z; }

 private:
  std::string bytes_;
};

/// A file that appears completely or not at all: it is written under a temporary name in the same folder, and `commit`
/// renames it. Without `commit` the destructor removes it, and so does a signal that ends the program, if it calls
/// `remove_unfinished_files`.
class OutputFile {
 public:
  /// \throw OutputError  the place is a folder, or cannot be written
  explicit OutputFile(std::filesystem::path target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Writes anything that a `TextBuffer` takes.
  template <class T>
  OutputFile& operator<<(const T& value) {
    buffer_ << value;
    if (buffer_.bytes().size() >= buffer_size) flush();
    return *this;
  }
  /// The bytes of a value in memory.
  template <class T>
  OutputFile& raw(const T& value) {
    return *this << std::string_view(reinterpret_cast<const char*>(&value), sizeof value);
  }

  /// Flushes and closes: everything that can fail before the renaming. \throw OutputError
  void close();
  /// Closes the file if necessary, and renames it. \throw OutputError
  void commit();

 private:
  static constexpr std::size_t buffer_size = 1 << 18;

  void flush();
  [[noreturn]] void fail(int error) const;

  std::filesystem::path target_, temporary_;
  std::optional<UnfinishedFile> unfinished_;
  std::FILE* stream_ = nullptr;
  TextBuffer buffer_;
  bool committed_ = false;
};

}  // namespace ccdt::io
