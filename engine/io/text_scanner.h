#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/point.h"
#include "engine/io/files.h"

namespace ccdt::io {

/// The item being read, for messages: "vertex 17". Items of kind "facet" are also added to the place of the error.
struct Item {
  std::string_view kind;
  std::int64_t number = -1;  ///< -1: none

  Item(const char* k) : kind(k) {}
  Item(std::string_view k) : kind(k) {}
  template <std::integral Integer>
  Item(std::string_view k, Integer n) : kind(k), number(static_cast<std::int64_t>(n)) {}

  std::string name() const;
  std::vector<long long> facets() const;
};

/// Reads the words of a text, for any format. All errors carry the file and the line, which is counted only when an
/// error needs it.
///
/// `line_end_of` determines the line ends.
class TextScanner {
 public:
  static constexpr int no_comments = -1;

  /// \param begin,end  the part of the file that is text
  /// \param comment    from this character on, the rest of a line is a comment
  explicit TextScanner(const FileBytes& file, int comment = '#', std::size_t begin = 0,
                       std::size_t end = std::string::npos);

  /// A backslash at the end of a line joins it with the next one (as in OBJ).
  void join_lines_at_backslash() { joins_lines_ = true; }

  /// Skips blanks, line ends and comments. \return is nothing left?
  bool at_end();
  /// Skips blanks. \return is nothing left on this line except a comment?
  bool at_line_end();
  void skip_line();
  /// Returns the rest of the line, trimmed, and goes to the next line.
  std::string_view rest_of_line();

  /// The next word, on any line. \throw InputError  the text ends
  std::string_view word(const Item& item);
  /// The next word without moving on; empty at the end.
  std::string_view peek();
  /// Reads a word, which must equal this one.
  void expect(const Item& item, std::string_view word, const std::string& remedy);

  double number(const Item& item);  ///< finite
  Point3 point(const Item& item);
  std::int64_t integer(const Item& item);
  /// Reads a whole number, which must equal `expected`. `it_is` begins the error message.
  void expect_integer(const Item& item, std::int64_t expected, const std::string& remedy, const char* it_is = "it is");
  /// A whole number that fits an int; also written as "3.0".
  int attribute(const Item& item);
  /// Reads an index from `first` to `first + count - 1`; returns it counted from 0.
  std::uint32_t index(const Item& item, std::int64_t first, std::size_t count);
  template <std::size_t Corners>
  std::array<std::uint32_t, Corners> indices(const Item& item, std::int64_t first, std::size_t count) {
    std::array<std::uint32_t, Corners> result;
    for (std::uint32_t& corner : result) corner = index(item, first, count);
    return result;
  }
  /// Reads the number of following items. Each needs at least this many bytes, and the rest of the file must be long
  /// enough.
  std::size_t count(const Item& item, std::size_t least_bytes_each);

  std::size_t position() const { return position_; }
  void move_to(std::size_t position) { position_ = word_begin_ = std::min(position, end_); }
  std::size_t remaining() const { return end_ - position_; }
  std::string_view rest() const { return text_.substr(position_, remaining()); }
  char line_end() const { return line_end_; }
  [[noreturn]] void fail(const Item& item, const std::string& what, const std::string& remedy = malformed_remedy) const;
  [[noreturn]] void fail_truncated(const Item& item) const;

  static constexpr const char* malformed_remedy = "correct this line, or export the file again";

 private:
  void skip_blanks(bool also_lines);
  bool is_blank(char c) const;  ///< but not a line end

  const FileBytes& file_;
  std::string_view text_;
  std::size_t position_, end_;
  std::size_t word_begin_;  ///< of the last word, where errors are
  int comment_;
  char line_end_;
  bool joins_lines_ = false;
};

/// The value of a word if it is a number, otherwise none.
template <std::integral Integer>
std::optional<Integer> parse_whole(std::string_view word) {
  Integer value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && stop == word.data() + word.size() ? std::optional(value) : std::nullopt;
}

/// A word for a message: in quotes, shortened, with unprintable characters replaced.
std::string in_quotes(std::string_view word);

/// Are the words equal, ignoring case?
bool equal_ignoring_case(std::string_view a, std::string_view lower);

}  // namespace ccdt::io
