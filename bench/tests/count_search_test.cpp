#include "bench/experiments/count_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

namespace ccdt {
namespace {

/// Counts like a mesher: nearly the third power of the edge length, and never fewer than the surface needs.
struct Mesher {
  double volume = 1e4, exponent = 3, least = 0;
  int fails_after = 1000;
  std::vector<double> tried = {};

  std::optional<std::uint64_t> operator()(double edge_length) {
    tried.push_back(edge_length);
    if (static_cast<int>(tried.size()) > fails_after) return {};
    return static_cast<std::uint64_t>(least + volume / std::pow(edge_length, exponent));
  }
};

TEST(CountSearch, NeedsTwoTriesWhereTheCountIsTheThirdPower) {
  Mesher mesher;
  const auto found = bench::search_edge_length({.wanted = 80000, .first = 1}, std::ref(mesher));
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_near);
  EXPECT_NEAR(found->edge_length, 0.5, 0.001);
  EXPECT_EQ(mesher.tried.size(), 2u);
}

TEST(CountSearch, FindsItsWayWhereTheCountGrowsOtherwise) {
  for (const double exponent : {1.2, 2.0, 4.5}) {
    Mesher mesher{.exponent = exponent, .least = 3000};
    const auto found = bench::search_edge_length({.wanted = 50000, .first = 1.5}, std::ref(mesher));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->is_near) << exponent;
    EXPECT_NEAR(found->count, 50000, 2500) << exponent;
  }
}

TEST(CountSearch, KeepsTheNearestTryWhereTheCountCannotBeReached) {
  Mesher mesher{.least = 20000};
  const auto found = bench::search_edge_length({.wanted = 10000, .first = 1}, std::ref(mesher));
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->is_near);
  EXPECT_LT(found->count, 20010);
  EXPECT_LE(mesher.tried.size(), 8u);
}

TEST(CountSearch, StaysWithinTheEdgeLengthsThatMayBeTried) {
  Mesher mesher;
  const auto found =
      bench::search_edge_length({.wanted = 1e9, .first = 1, .shortest = 0.4, .longest = 2}, std::ref(mesher));
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->is_near);
  EXPECT_NEAR(found->edge_length, 0.4, 1e-9);
  for (const double tried : mesher.tried) EXPECT_GE(tried, 0.4);
}

TEST(CountSearch, EndsWhereTheMesherFails) {
  Mesher never{.fails_after = 0};
  EXPECT_FALSE(bench::search_edge_length({.wanted = 1e6, .first = 1}, std::ref(never)));
  EXPECT_EQ(never.tried.size(), 1u);
  Mesher once{.fails_after = 1};
  const auto found = bench::search_edge_length({.wanted = 1e6, .first = 1}, std::ref(once));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->edge_length, 1);
}

TEST(CountSearch, EndsWhenLongerEdgesMakeHardlyFewer) {
  int tries = 0;
  const auto found =
      bench::search_edge_length({.wanted = 1000, .first = 1}, [&](double) -> std::optional<std::uint64_t> {
        ++tries;
        return 5000;
      });
  EXPECT_EQ(tries, 2);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->is_near);
}

}  // namespace
}  // namespace ccdt
