#pragma once

#include <charconv>
#include <concepts>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/point.h"

namespace ccdt::io {

/// A file that appears whole or not at all: it is written beside its place under a temporary name and renamed by
/// `commit`. Without `commit` the destructor removes it. Numbers are written in the shortest form that reads back bit
/// for bit.
class OutputFile {
 public:
  /// \throw OutputError  the place is a directory, or cannot be written
  explicit OutputFile(std::filesystem::path target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  OutputFile& operator<<(std::string_view text);
  OutputFile& operator<<(const char* text) { return *this << std::string_view(text); }
  OutputFile& operator<<(char c) { return *this << std::string_view(&c, 1); }
  template <class Number>
  requires(std::integral<Number> || std::same_as<Number, double>) OutputFile& operator<<(Number value) {
    char digits[40];
    return *this << std::string_view(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
  }
  OutputFile& operator<<(const Point3& p) { return *this << p.x << ' ' << p.y << ' ' << p.z; }
  /// The bytes of a value as they are in memory.
  template <class T>
  OutputFile& raw(const T& value) {
    return *this << std::string_view(reinterpret_cast<const char*>(&value), sizeof value);
  }

  /// Flushes and closes: everything that can fail short of the renaming. \throw OutputError
  void close();
  /// Closes if that is still to do, and renames. \throw OutputError
  void commit();

 private:
  void flush();
  [[noreturn]] void fail(int error) const;

  std::filesystem::path target_, temporary_;
  std::FILE* stream_ = nullptr;
  std::string buffer_;
  bool committed_ = false;
};

}  // namespace ccdt::io
