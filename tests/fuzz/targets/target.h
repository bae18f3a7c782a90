#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "engine/base/errors.h"

/// What a fuzzer tries with some bytes. Whatever leaves it as an exception is a bug.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace ccdt::fuzz {

/// Bytes that decide what is tried. After the last one, all are 0.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}

  bool empty() const { return bytes_.empty(); }
  std::uint8_t next() {
    if (bytes_.empty()) return 0;
    const std::uint8_t byte = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return byte;
  }
  /// 0 to `count` - 1. \pre 0 < count <= 256
  std::size_t below(std::size_t count) { return next() % count; }
  bool flag() { return next() % 2 != 0; }
  template <class Choices>
  auto pick(const Choices& choices) {
    return choices[below(std::size(choices))];
  }
  /// A value of an enumeration with names.
  template <class Enum>
  Enum pick() {
    return pick(names_of(Enum{})).value;
  }
  std::span<const std::uint8_t> rest() const { return bytes_; }
  std::string_view text() const { return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()}; }

 private:
  std::span<const std::uint8_t> bytes_;
};

/// Runs something that may refuse what it is given: with an error of ours, or because there is not enough memory.
/// \return  did it accept?
template <class Run>
bool accepts(const Run& run) {
  try {
    run();
    return true;
  } catch (const Error&) {
  } catch (const std::bad_alloc&) {
  }
  return false;
}

/// Something that must hold.
inline void require(bool holds, const std::string& what) {
  if (!holds) throw std::logic_error(what);
}

}  // namespace ccdt::fuzz
