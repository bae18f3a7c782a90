#include "tools/page_pool.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "engine/tests/shared/little_memory.h"
#include "engine/tests/shared/sanitized.h"

namespace ccdt {
namespace {

using tools::PagePool;

constexpr std::size_t mib = std::size_t{1} << 20;

std::size_t page_size() {
  return static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::span<unsigned char> filled(void* place, std::size_t bytes, unsigned char value) {
  std::memset(place, value, bytes);
  return {static_cast<unsigned char*>(place), bytes};
}

/// How many pages of a block exist.
std::size_t pages_in_memory(void* place, std::size_t bytes) {
  std::vector<unsigned char> in_memory((bytes + page_size() - 1) / page_size());
  EXPECT_EQ(mincore(place, bytes, in_memory.data()), 0);
  return static_cast<std::size_t>(std::ranges::count_if(in_memory, [](unsigned char page) { return (page & 1) != 0; }));
}

TEST(PagePool, AlignsBlocksToLargePages) {
  PagePool pool;
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{1}, page_size(), 3 * mib + 1}) {
    void* const block = pool.take(bytes);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % PagePool::alignment, 0u);
    filled(block, bytes, 1);
    EXPECT_TRUE(pool.give_back(block));
  }
}

TEST(PagePool, HandsPagesOnToBlocksOfAnySize) {
  PagePool pool;
  void* const first = pool.take(5 * mib);
  void* const second = pool.take(7 * mib);
  filled(first, 5 * mib, 1), filled(second, 7 * mib, 2);
  EXPECT_TRUE(pool.give_back(first));
  EXPECT_TRUE(pool.give_back(second));

  void* const both = pool.take(13 * mib);
  EXPECT_EQ(pages_in_memory(both, 13 * mib), 12 * mib / page_size());
  filled(both, 13 * mib, 3);
  EXPECT_TRUE(pool.give_back(both));

  std::vector<void*> parts;
  for (int i = 0; i < 4; ++i) {
    parts.push_back(pool.take(3 * mib));
    EXPECT_EQ(pages_in_memory(parts.back(), 3 * mib), 3 * mib / page_size());
  }
  for (void* const part : parts) EXPECT_TRUE(pool.give_back(part));
}

TEST(PagePool, HandsOnOnlyPagesThatWereUsed) {
  PagePool pool;
  void* const first = pool.take(8 * mib);
  void* const second = pool.take(2 * mib);
  filled(first, mib, 1), filled(second, 2 * mib, 2);
  EXPECT_TRUE(pool.give_back(first));
  EXPECT_TRUE(pool.give_back(second));
  void* const both = pool.take(3 * mib);
  EXPECT_EQ(pages_in_memory(both, 3 * mib), 3 * mib / page_size());
  EXPECT_TRUE(pool.give_back(both));

  EXPECT_TRUE(pool.give_back(pool.take(mib)));
}

/// Older kernels do not move pages with different settings together.
TEST(PagePool, HandsOnPagesWithDifferentSettings) {
  PagePool pool;
  void* const block = pool.take(8 * mib);
  filled(block, 8 * mib, 1);
  madvise(block, 4 * mib, MADV_DONTFORK);
  EXPECT_TRUE(pool.give_back(block));
  void* const next = pool.take(9 * mib);
  filled(next, 9 * mib, 2);
  EXPECT_TRUE(pool.give_back(next));
}

TEST(PagePool, TakesBackOnlyItsOwnBlocks) {
  PagePool pool, other;
  void* const block = pool.take(mib);
  EXPECT_FALSE(other.give_back(block));
  EXPECT_FALSE(pool.give_back(static_cast<char*>(block) + page_size()));
  EXPECT_FALSE(pool.give_back(nullptr));
  EXPECT_TRUE(pool.give_back(block));
  EXPECT_FALSE(pool.give_back(block));
}

TEST(PagePool, RefusesWhatDoesNotExist) {
  PagePool pool;
  EXPECT_THROW(pool.take(std::size_t{1} << 62), std::bad_alloc);
  EXPECT_THROW(pool.take(~std::size_t{0}), std::bad_alloc);
  void* const block = pool.take(mib);
  filled(block, mib, 1);
  EXPECT_TRUE(pool.give_back(block));
}

TEST(PagePool, GivesFreePagesBackBeforeMemoryRunsOut) {
  PagePool pool;
  const LittleMemory memory(100 * mib);
  void* const first = pool.take(60 * mib);
  EXPECT_TRUE(pool.give_back(first));
  void* const second = pool.take(80 * mib);
  if (!is_sanitized) {
    EXPECT_THROW(pool.take(60 * mib), std::bad_alloc);
  }
  filled(second, 80 * mib, 1);
  EXPECT_TRUE(pool.give_back(second));
}

TEST(PagePool, KeepsBlocksApart) {
  PagePool pool;
  std::mt19937 random(1);
  struct Block {
    std::span<unsigned char> bytes;
    unsigned char value;
  };
  std::vector<Block> blocks;
  for (int step = 0; step < 2000; ++step) {
    if (blocks.size() < 8 && random() % 2 == 0) {
      const std::size_t bytes = 1 + random() % (std::size_t{1} << (12 + random() % 11));
      const auto value = static_cast<unsigned char>(step);
      blocks.push_back({filled(pool.take(bytes), bytes, value), value});
    } else if (!blocks.empty()) {
      std::swap(blocks[random() % blocks.size()], blocks.back());
      const Block& last = blocks.back();
      EXPECT_TRUE(std::ranges::all_of(last.bytes, [&](unsigned char byte) { return byte == last.value; }));
      EXPECT_TRUE(pool.give_back(last.bytes.data()));
      blocks.pop_back();
    }
  }
  for (const Block& block : blocks) EXPECT_TRUE(pool.give_back(block.bytes.data()));
}

}  // namespace
}  // namespace ccdt
