#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/hash_table.h"
#include "engine/base/parallel.h"
#include "engine/base/sort_in_buckets.h"

namespace ccdt {
namespace {

/// Many keys with one home, and homes at the end of the array, where chains wrap around.
struct CrowdedTraits {
  static std::uint32_t none() { return 0xFFFFFFFFu; }
  static std::size_t hash(std::uint32_t key) { return ~std::size_t{0} - key % 5; }
};

TEST(HashTable, HoldsWhatAMapHoldsAfterRandomInsertionsAndRemovals) {
  HashTable<std::uint32_t, int, CrowdedTraits> table;
  std::map<std::uint32_t, int> map;
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    const std::uint32_t key = random() % 60;
    if (random() % 2) {
      EXPECT_EQ(table.insert(key, i).second, map.try_emplace(key, i).second);
    } else if (const int* value = table.find(key); value != nullptr) {
      EXPECT_EQ(map.at(key), *value);
      table.erase(value);
      map.erase(key);
    }
    ASSERT_EQ(table.size(), map.size());
  }
  for (std::uint32_t key = 0; key < 60; ++key) EXPECT_EQ(table.find(key) != nullptr, map.count(key) == 1);
  std::map<std::uint32_t, int> all;
  table.for_each([&](std::uint32_t key, int value) { all[key] = value; });
  EXPECT_EQ(all, map);
}

/// Few and many items, in few and many buckets, so that all of them are in one range, in some or in each.
TEST(SortInBuckets, OrdersAsASortDoes) {
  using Item = std::pair<std::uint32_t, std::uint32_t>;
  std::mt19937 random(17);
  for (const std::size_t count : {0, 1, 2, 1000, 40000, 150000}) {
    for (const std::uint32_t buckets : {1u, 2u, 255u, 256u, 257u, 30000u, 2000000u}) {
      std::vector<Item> items;
      for (std::uint32_t i = 0; i < count; ++i) items.push_back({static_cast<std::uint32_t>(random() % buckets), i});
      std::ranges::shuffle(items, random);
      std::vector<Item> expected = items;
      std::ranges::sort(expected);
      for (const unsigned threads : {1u, 3u}) {
        std::vector<Item> sorted = items;
        with_threads(threads, [&] { sort_in_buckets(sorted, [](const Item& item) { return item.first; }); });
        ASSERT_EQ(sorted, expected) << count << " items, " << buckets << " buckets, " << threads << " threads";
      }
    }
  }
}

TEST(Errors, GetTheNameOfTheFileUnlessTheyHaveOne) {
  for (const std::string name : {"", "background.mesh"}) {
    try {
      with_file_in_errors("part.stl",
                          [&]() -> int { throw LimitError("too many", {.file = name, .line = 7}, "fewer"); });
      FAIL();
    } catch (const LimitError& error) {
      EXPECT_EQ(error.place().file, name.empty() ? "part.stl" : name);
      EXPECT_EQ(error.place().line, 7);
    }
  }
  EXPECT_EQ(with_file_in_errors("part.stl", [] { return 7; }), 7);
}

}  // namespace
}  // namespace ccdt
