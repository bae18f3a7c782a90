#pragma once

#include "engine/io/byte_scanner.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {

/// The numbers of a section of a Gmsh file, which are the same in text and in binary: in binary, Gmsh's integers have
/// 32 bits and its sizes 64. The names of sections, and everything before the first one, are always text.
class GmshSource {
 public:
  explicit GmshSource(const FileBytes& file) : text_(file, TextScanner::no_comments), bytes_(file), file_(file) {}

  TextScanner& text() { return text_; }

  /// From here on, sections are binary. Reads the number 1 after the format's line, which shows the byte order.
  void become_binary(const Item& item) {
    binary_ = true;
    begin_numbers();
    const std::int32_t one = bytes_.next<std::int32_t>(item);
    if (one != 1 && one != 1 << 24) bytes_.fail(item, "the number 1, which shows the byte order, is not there");
    bytes_.set_big_endian(one != 1);
    end_numbers();
  }
  bool is_binary() const { return binary_; }

  /// Moves to the next line, where the numbers begin.
  void begin_numbers() {
    if (!binary_) return;
    text_.skip_line();
    bytes_.move_to(text_.position());
  }
  /// Continues with text.
  void end_numbers() {
    if (binary_) text_.move_to(bytes_.position());
  }
  /// In text, skips the rest of the line, where nothing is needed.
  void skip_line() {
    if (!binary_) text_.skip_line();
  }
  /// Moves to the next occurrence of this text.
  void skip_to(std::string_view end, const Item& item) {
    const std::size_t found = file_.bytes.find(end, text_.position());
    if (found == std::string_view::npos) text_.fail_truncated(item);
    text_.move_to(found);
  }

  std::int64_t integer(const Item& item) { return binary_ ? bytes_.next<std::int32_t>(item) : text_.integer(item); }
  std::int64_t size(const Item& item) { return binary_ ? bytes_.next<std::int64_t>(item) : text_.integer(item); }
  Point3 point(const Item& item) { return binary_ ? bytes_.point<double>(item) : text_.point(item); }
  int attribute(const Item& item) { return binary_ ? bytes_.attribute<std::int32_t>(item) : text_.attribute(item); }
  /// Skips real numbers that are not needed.
  void skip_numbers(const Item& item, std::size_t count) {
    if (binary_) return bytes_.skip(item, count * sizeof(double));
    for (std::size_t k = 0; k < count; ++k) text_.word(item);
  }
  void skip_integers(const Item& item, std::size_t count) {
    if (binary_) return bytes_.skip(item, count * sizeof(std::int32_t));
    for (std::size_t k = 0; k < count; ++k) text_.word(item);
  }
  /// Reads how many items follow, given the least size of each in text and in binary.
  std::size_t count(const Item& item, std::size_t least_characters_each, std::size_t least_bytes_each) {
    return binary_ ? bytes_.count<std::int64_t>(item, least_bytes_each) : text_.count(item, least_characters_each);
  }
  /// The same for a count that has 32 bits in binary.
  std::size_t short_count(const Item& item, std::size_t least_characters_each, std::size_t least_bytes_each) {
    return binary_ ? bytes_.count<std::int32_t>(item, least_bytes_each) : text_.count(item, least_characters_each);
  }

  [[noreturn]] void fail(const Item& item, const std::string& what,
                         const std::string& remedy = "export the file again") const {
    if (binary_) bytes_.fail(item, what, remedy);
    text_.fail(item, what, remedy);
  }

 private:
  TextScanner text_;
  ByteScanner bytes_;
  const FileBytes& file_;
  bool binary_ = false;
};

}  // namespace ccdt::io
