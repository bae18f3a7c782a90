#include "bench/run/numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace ccdt::bench {
namespace {

/// The number with this many digits after the point.
std::string with_decimals(double value, int decimals) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

/// The number of digits after the point for this many significant digits.
int decimals_for(double value, int digits) {
  const double size = std::abs(value);
  if (!(size > 0) || !std::isfinite(size)) return 0;
  return std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(size))));
}

}  // namespace

std::string rounded(double value, int digits) {
  const double size = std::abs(value);
  if (std::isfinite(size) && size > 0 && (size < 1e-4 || size >= 1e15)) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    return text.data();
  }
  return with_decimals(value, decimals_for(value, digits));
}

std::string with_interval(const Estimate& e) {
  if (!e.has_interval()) return rounded(e.value);
  // Three digits of the value, or two of the interval's width if that takes more, but not more than five of the value.
  const int decimals =
      std::min(std::max(decimals_for(e.value, 3), decimals_for(e.high - e.low, 2)), decimals_for(e.value, 5));
  return with_decimals(e.value, decimals) + " [" + with_decimals(e.low, decimals) + ", " +
         with_decimals(e.high, decimals) + "]";
}

std::string percent(double share) {
  return rounded(100 * share) + "%";
}

std::string with_separators(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, ",");
  return text;
}

std::string mebibytes(std::uint64_t bytes) {
  return with_separators((bytes + (1u << 19)) >> 20) + " MiB";
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) text.append(i == 0 ? "" : separator).append(words[i]);
  return text;
}

}  // namespace ccdt::bench
