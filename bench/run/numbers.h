#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bench/run/statistics.h"

namespace ccdt::bench {

/// A number with this many significant digits, without an exponent if possible.
std::string rounded(double value, int digits = 3);

/// An estimate with its interval, with as many digits as needed to tell them apart: "1.02 [1.01, 1.03]"; without
/// one "1.02".
std::string with_interval(const Estimate& estimate);

/// 0.0312 as "3.12%".
std::string percent(double share);

/// 1234567 as "1,234,567".
std::string with_separators(std::uint64_t count);

/// Bytes as "12 MiB".
std::string mebibytes(std::uint64_t bytes);

/// The words with the separator between them: "a, b, c".
std::string joined(const std::vector<std::string>& words, std::string_view separator = ", ");

}  // namespace ccdt::bench
