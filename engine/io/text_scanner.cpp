#include "engine/io/text_scanner.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "engine/base/errors.h"
#include "engine/base/platform.h"

namespace ccdt::io {

namespace {

/// Editors on Windows begin a text in UTF-8 with this mark.
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// The byte where the text's first word may begin.
std::size_t begin_of_words(std::string_view text, std::size_t begin) {
  if (begin == 0 && text.starts_with(byte_order_mark)) return byte_order_mark.size();
  return std::min(begin, text.size());
}

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

constexpr std::size_t most_things = 0xFFFFFFFEu;  // indices have 32 bits, and one value is `none`

std::string expected(const std::string& what, std::string_view found) {
  return "expected " + what + ", found " + in_quotes(found);
}

/// Skips a plus sign, which from_chars does not accept.
const char* digits_begin(std::string_view word) {
  return word.size() > 1 && word[0] == '+' ? word.data() + 1 : word.data();
}

std::optional<double> parse_number(std::string_view word) {
  const char* end = word.data() + word.size();
  double value = 0;
  const auto [stop, error] = from_chars(digits_begin(word), end, value);
  if (stop != end) return std::nullopt;
  // The number is too large or too small for a double; strtod says which. from_chars has already accepted its form.
  if (error == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);
  if (error != std::errc()) return std::nullopt;
  return value;
}

}  // namespace

std::string Item::name() const {
  return std::string(kind) + (number >= 0 ? " " + std::to_string(number) : "");
}

std::vector<long long> Item::facets() const {
  return kind == "facet" && number >= 0 ? std::vector<long long>{number} : std::vector<long long>{};
}

std::string in_quotes(std::string_view word) {
  std::string result = "'";
  for (const char c : word.substr(0, 40)) result += c >= 32 && c < 127 ? c : '?';
  return result + (word.size() > 40 ? "...'" : "'");
}

bool equal_ignoring_case(std::string_view a, std::string_view lower) {
  return std::equal(a.begin(), a.end(), lower.begin(), lower.end(),
                    [](char x, char y) { return (x >= 'A' && x <= 'Z' ? x - 'A' + 'a' : x) == y; });
}

TextScanner::TextScanner(const FileBytes& file, int comment, std::size_t begin, std::size_t end)
    : file_(file),
      text_(file.bytes),
      position_(begin_of_words(text_, begin)),
      end_(std::min(end, file.bytes.size())),
      word_begin_(position_),
      comment_(comment),
      line_end_(line_end_of(text_.substr(position_, end_ - position_))) {}

bool TextScanner::is_blank(char c) const {
  return is_space(c) && c != line_end_;
}

void TextScanner::skip_blanks(bool also_lines) {
  while (position_ < end_) {
    const char c = text_[position_];
    if (is_blank(c) || (also_lines && c == line_end_)) {
      ++position_;
    } else if (also_lines && static_cast<unsigned char>(c) == comment_) {
      skip_line();
    } else if (joins_lines_ && c == '\\') {
      std::size_t next = position_ + 1;
      if (next < end_ && text_[next] == '\r' && line_end_ != '\r') ++next;
      if (next >= end_ || text_[next] != line_end_) return;
      position_ = next + 1;
    } else {
      return;
    }
  }
}

bool TextScanner::at_end() {
  skip_blanks(true);
  return position_ >= end_;
}

bool TextScanner::at_line_end() {
  skip_blanks(false);
  return position_ >= end_ || text_[position_] == line_end_ || static_cast<unsigned char>(text_[position_]) == comment_;
}

void TextScanner::skip_line() {
  position_ = std::min(text_.find(line_end_, position_), end_);
  if (position_ < end_) ++position_;
}

std::string_view TextScanner::rest_of_line() {
  skip_blanks(false);
  word_begin_ = position_;
  skip_line();
  std::string_view rest = text_.substr(word_begin_, position_ - word_begin_);
  while (!rest.empty() && is_space(rest.back())) rest.remove_suffix(1);
  return rest;
}

std::string_view TextScanner::word(const Item& item) {
  skip_blanks(true);
  if (position_ >= end_) fail_truncated(item);
  word_begin_ = position_;
  while (position_ < end_ && !is_space(text_[position_]) && static_cast<unsigned char>(text_[position_]) != comment_)
    ++position_;
  return text_.substr(word_begin_, position_ - word_begin_);
}

std::string_view TextScanner::peek() {
  if (at_end()) return {};
  const std::size_t before = position_;
  const std::string_view next = word({"word"});
  position_ = before;
  return next;
}

void TextScanner::expect(const Item& item, std::string_view word, const std::string& remedy) {
  const std::string_view found = this->word(item);
  if (found != word) fail(item, expected("'" + std::string(word) + "'", found), remedy);
}

double TextScanner::number(const Item& item) {
  const std::string_view found = word(item);
  const std::optional<double> value = parse_number(found);
  if (!value) fail(item, expected("a number", found));
  if (!std::isfinite(*value))
    fail(item, in_quotes(found) + " is not a finite number", "correct this number, or export the file again");
  return *value;
}

Point3 TextScanner::point(const Item& item) {
  const double x = number(item), y = number(item), z = number(item);
  return {x, y, z};
}

std::int64_t TextScanner::integer(const Item& item) {
  const std::string_view found = word(item);
  const char* end = found.data() + found.size();
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(digits_begin(found), end, value);
  if (error != std::errc() || stop != end) fail(item, expected("a whole number", found));
  return value;
}

void TextScanner::expect_integer(const Item& item, std::int64_t expected, const std::string& remedy,
                                 const char* it_is) {
  if (const std::int64_t value = integer(item); value != expected)
    fail(item, std::string(it_is) + " " + std::to_string(value) + ", not " + std::to_string(expected), remedy);
}

int TextScanner::attribute(const Item& item) {
  const double value = number(item);
  if (value != std::floor(value) || value < INT_MIN || value > INT_MAX)
    fail(item, expected("a whole number of 32 bits", text_.substr(word_begin_, position_ - word_begin_)),
         "use whole numbers for regions and markers");
  return static_cast<int>(value);
}

std::uint32_t TextScanner::index(const Item& item, std::int64_t first, std::size_t count) {
  const std::int64_t value = integer(item);
  if (value < first || value - first >= static_cast<std::int64_t>(count)) {
    const std::string range = count == 0 ? "the file has no vertices"
                                         : "the file's vertices are " + std::to_string(first) + " to " +
                                               std::to_string(first + static_cast<std::int64_t>(count) - 1);
    fail(item, "vertex index " + std::to_string(value) + " is out of range: " + range);
  }
  return static_cast<std::uint32_t>(value - first);
}

std::size_t TextScanner::count(const Item& item, std::size_t least_bytes_each) {
  const std::int64_t value = integer(item);
  if (value < 0) fail(item, std::to_string(value) + " is negative");
  const std::size_t result = static_cast<std::size_t>(value);
  if (result > most_things) fail(item, std::to_string(value) + " is more than " + std::to_string(most_things));
  if (result * least_bytes_each > remaining() + 1)  // the last line needs no line end
    fail(item,
         std::to_string(value) + " are claimed, which need at least " + std::to_string(result * least_bytes_each) +
             " bytes, but only " + std::to_string(remaining()) + " bytes follow",
         "the file is truncated or its header is wrong: export it again");
  return result;
}

void TextScanner::fail(const Item& item, const std::string& what, const std::string& remedy) const {
  Place place = line_of_byte(file_, word_begin_);
  place.facets = item.facets();
  throw InputError(item.name() + ": " + what, std::move(place), remedy);
}

void TextScanner::fail_truncated(const Item& item) const {
  Place place = line_of_byte(file_, end_);
  place.byte = static_cast<long long>(end_);
  place.facets = item.facets();
  throw InputError("the file is truncated: it ends within or before " + item.name(), std::move(place),
                   "copy or export the file again");
}

}  // namespace ccdt::io
