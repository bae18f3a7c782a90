#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "engine/io/files.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {

/// Walks over the numbers of a binary file, as `TextScanner` walks over words: all errors carry the file and the byte.
class ByteScanner {
 public:
  explicit ByteScanner(const FileBytes& file, std::size_t begin = 0) : file_(file), position_(begin), begin_(begin) {}

  void set_big_endian(bool big_endian) { big_endian_ = big_endian; }

  /// The next bytes. \throw InputError  the file ends
  const char* take(const Item& item, std::size_t bytes) {
    skip(item, bytes);
    return file_.bytes.data() + begin_;
  }
  /// The next number. \throw InputError  the file ends
  template <class Number>
  Number next(const Item& item) {
    return number_at<Number>(take(item, sizeof(Number)), big_endian_);
  }

  /// A finite coordinate in single or double precision.
  template <class Real>
  double coordinate(const Item& item) {
    const double value = static_cast<double>(next<Real>(item));
    if (!std::isfinite(value)) fail(item, "a coordinate is not a finite number (NaN or infinite)");
    return value;
  }
  template <class Real>
  Point3 point(const Item& item) {
    const double x = coordinate<Real>(item), y = coordinate<Real>(item), z = coordinate<Real>(item);
    return {x, y, z};
  }

  /// A region or a marker.
  template <class Integer>
  int attribute(const Item& item) {
    const Integer value = next<Integer>(item);
    if (!std::in_range<int>(value))
      fail(item, std::to_string(value) + " does not fit in 32 bits", "use smaller numbers for regions and markers");
    return static_cast<int>(value);
  }

  /// The number of items that follow. Each needs this many bytes, and the rest of the file must be long enough.
  template <class Integer>
  std::size_t count(const Item& item, std::size_t bytes_each) {
    const Integer value = next<Integer>(item);
    if (!std::in_range<std::uint32_t>(value) || static_cast<std::uint32_t>(value) == 0xFFFFFFFFu)
      fail(item, std::to_string(value) + " is not a number from 0 to 4294967294");
    const std::size_t result = static_cast<std::size_t>(value);
    if (result * bytes_each > remaining())
      fail(item,
           std::to_string(result) + " are claimed, which need " + std::to_string(result * bytes_each) +
               " bytes, but only " + std::to_string(remaining()) + " bytes follow",
           "the file is truncated or its header is wrong: export it again");
    return result;
  }

  void skip(const Item& item, std::size_t bytes) {
    if (bytes > remaining()) fail_truncated(item);
    begin_ = position_;
    position_ += bytes;
  }
  void move_to(std::size_t position) { begin_ = position_ = position; }

  std::size_t position() const { return position_; }
  std::size_t remaining() const { return file_.bytes.size() - position_; }
  [[noreturn]] void fail(const Item& item, const std::string& what, const std::string& remedy = damaged_remedy) const {
    fail_at_byte(file_, begin_, item.name() + ": " + what, remedy, item.facets());
  }
  [[noreturn]] void fail_truncated(const Item& item) const {
    fail_at_byte(file_, file_.bytes.size(), "the file is truncated: it ends within or before " + item.name(),
                 "copy or export the file again", item.facets());
  }

  static constexpr const char* damaged_remedy = "the file is damaged: export it again";

 private:
  const FileBytes& file_;
  std::size_t position_, begin_;  ///< `begin_` of the last number, where errors are
  bool big_endian_ = false;
};

}  // namespace ccdt::io
