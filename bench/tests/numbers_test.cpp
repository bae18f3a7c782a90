#include "bench/run/numbers.h"

#include <gtest/gtest.h>

#include <limits>

namespace ccdt {
namespace {

TEST(Numbers, AreRoundedToSignificantDigits) {
  EXPECT_EQ(bench::rounded(602.25), "602");
  EXPECT_EQ(bench::rounded(26.014), "26.0");
  EXPECT_EQ(bench::rounded(0.0012345), "0.00123");
  EXPECT_EQ(bench::rounded(1.23456e-7), "1.23e-07");
  EXPECT_EQ(bench::rounded(0), "0");
  EXPECT_EQ(bench::rounded(-2.5, 2), "-2.5");
  EXPECT_EQ(bench::rounded(std::numeric_limits<double>::infinity()), "inf");
}

TEST(Numbers, IntervalsHaveTheDigitsThatTellThemApart) {
  EXPECT_EQ(bench::with_interval({1.0188, 1.0151, 1.0223}), "1.0188 [1.0151, 1.0223]");
  EXPECT_EQ(bench::with_interval({23.4, 20.1, 27.9}), "23.4 [20.1, 27.9]");
  EXPECT_EQ(bench::with_interval({5, 5, 5}), "5.00 [5.00, 5.00]");
  EXPECT_EQ(bench::with_interval(bench::without_interval(23.4)), "23.4");
}

TEST(Numbers, LargeCountsHaveSeparators) {
  EXPECT_EQ(bench::with_separators(0), "0");
  EXPECT_EQ(bench::with_separators(999), "999");
  EXPECT_EQ(bench::with_separators(1000), "1,000");
  EXPECT_EQ(bench::with_separators(1234567), "1,234,567");
}

TEST(Numbers, BytesAreMebibytes) {
  EXPECT_EQ(bench::mebibytes(12u << 20), "12 MiB");
}

}  // namespace
}  // namespace ccdt
