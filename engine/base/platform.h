#pragma once

#include <atomic>
#include <charconv>
#include <type_traits>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
#define CCDT_PARSES_WITH_STRTOD
#include <locale.h>
#include <stdlib.h>

#include <cerrno>
#include <string>
#include <string_view>
#endif

// What compilers and libraries add to C++20 or leave out of it, with what is done without it. The engine also needs the
// vectors (`vector_size`) and the 128-bit integers of GCC and Clang; large pages are in raw_vector.cpp alone.

#if defined(__GNUC__) || defined(__clang__)
#define CCDT_ALWAYS_INLINE inline __attribute__((always_inline))
#else
#define CCDT_ALWAYS_INLINE inline
#endif

// Compiles a function once for every x86-64 and once for processors with 256-bit lanes; the program picks when it
// starts. Signs are the same: neither version contracts to FMA. (The sanitizers' runtimes do not support this.)
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define CCDT_WIDE_LANES __attribute__((target_clones("avx2", "default")))
#else
#define CCDT_WIDE_LANES
#endif

namespace ccdt {

/// Says that memory will soon be read.
CCDT_ALWAYS_INLINE void prefetch([[maybe_unused]] const void* place) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(place);
#endif
}

#ifndef __cpp_lib_atomic_ref

/// What the engine needs of std::atomic_ref, for libraries without it (libc++ before 19).
template <class Value>
class AtomicRef {
 public:
  explicit AtomicRef(Value& value) : value_(value) {}
  Value load(std::memory_order order = std::memory_order_seq_cst) const {
    Value result;
    __atomic_load(&value_, &result, static_cast<int>(order));
    return result;
  }
  void store(Value value, std::memory_order order) const { __atomic_store(&value_, &value, static_cast<int>(order)); }
  Value fetch_add(Value value, std::memory_order order) const {
    return __atomic_fetch_add(&value_, value, static_cast<int>(order));
  }
  Value fetch_or(Value value, std::memory_order order) const {
    return __atomic_fetch_or(&value_, value, static_cast<int>(order));
  }
  Value fetch_and(Value value, std::memory_order order) const {
    return __atomic_fetch_and(&value_, value, static_cast<int>(order));
  }
  bool compare_exchange_weak(Value& expected, Value value, std::memory_order order) const {
    return __atomic_compare_exchange(&value_, &expected, &value, true, static_cast<int>(order), __ATOMIC_RELAXED);
  }
  bool compare_exchange_strong(Value& expected, Value value, std::memory_order order) const {
    return __atomic_compare_exchange(&value_, &expected, &value, false, static_cast<int>(order), __ATOMIC_RELAXED);
  }

 private:
  Value& value_;
};

#endif

/// A value that several threads change.
template <class Value>
auto as_atomic(Value& value) {
#ifdef __cpp_lib_atomic_ref
  return std::atomic_ref<Value>(value);
#else
  return AtomicRef<Value>(value);
#endif
}

/// std::from_chars, also where the library has it for integers only (libc++ before 20).
template <class Number>
std::from_chars_result from_chars(const char* first, const char* last, Number& number) {
#ifdef CCDT_PARSES_WITH_STRTOD
  if constexpr (std::is_floating_point_v<Number>) {
    // strtod would also take spaces, a plus sign and hexadecimal digits.
    const std::string_view all(first, static_cast<std::size_t>(last - first));
    const std::string word(all.substr(0, all.find_first_not_of("0123456789+-.eEinfatyINFATY")));
    static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
    if (word.starts_with('+')) return {first, std::errc::invalid_argument};
    char* end = nullptr;
    errno = 0;
    const double value = strtod_l(word.c_str(), &end, plain);
    const char* const stop = first + (end - word.c_str());
    if (stop == first) return {first, std::errc::invalid_argument};
    if (errno == ERANGE) return {stop, std::errc::result_out_of_range};
    number = static_cast<Number>(value);
    return {stop, std::errc()};
  } else
#endif
    return std::from_chars(first, last, number);
}

}  // namespace ccdt
