#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "baselines/external_program.h"
#include "bench/sweep/chunks.h"
#include "bench/sweep/slurm.h"
#include "engine/base/errors.h"

namespace ccdt::sweep {
namespace {

using Ids = std::vector<std::string>;

std::vector<Ids> ids_of(const std::vector<Chunk>& chunks) {
  std::vector<Ids> ids;
  for (const Chunk& chunk : chunks) ids.push_back(chunk.cases);
  return ids;
}

TEST(Chunks, AreFilledUpToTheirLength) {
  const std::vector<MissingCase> cases = {
      {"a", "1", 4, 1}, {"b", "2", 4, 1}, {"c", "3", 4, 2}, {"d", "4", 4, 1}, {"e", "5", 1, 1}};
  const auto chunks = cut_into_chunks(cases, 10);
  EXPECT_EQ(ids_of(chunks), (std::vector<Ids>{{"a", "b"}, {"c", "d", "e"}}));
  EXPECT_EQ(chunks[1].seconds, 9);
  EXPECT_EQ(chunks[0].threads, 1);
  EXPECT_EQ(chunks[1].threads, 2);
}

TEST(Chunks, KeepGroupsTogetherUnlessOneIsLongerByItself) {
  const std::vector<MissingCase> cases = {{"a", "x", 3, 1}, {"b", "y", 6, 1}, {"c", "x", 3, 1},
                                          {"d", "y", 6, 1}, {"e", "z", 2, 1}, {"f", "x", 3, 1}};
  EXPECT_EQ(ids_of(cut_into_chunks(cases, 10)), (std::vector<Ids>{{"a", "c", "f"}, {"b"}, {"d", "e"}}));
}

TEST(Chunks, HoldACaseThatIsLongerThanAChunk) {
  const std::vector<MissingCase> cases = {{"a", "", 100, 1}, {"b", "", 1, 1}};
  EXPECT_EQ(ids_of(cut_into_chunks(cases, 10)), (std::vector<Ids>{{"a"}, {"b"}}));
  EXPECT_TRUE(cut_into_chunks({}, 10).empty());
}

TEST(Chunks, KeepTheirNumbersAndFiles) {
  const baselines::TemporaryFolder folder;
  std::vector<Chunk> first = {{.cases = {"a", "b"}, .seconds = 3, .threads = 2}, {.cases = {"c"}}};
  write_chunks(folder.path(), first);
  EXPECT_EQ(first[0].number, 0);
  EXPECT_EQ(first[1].number, 1);
  std::vector<Chunk> second = {{.cases = {"c"}}, {.cases = {"b"}}};
  write_chunks(folder.path(), second);
  EXPECT_EQ(second[0].number, 1);
  EXPECT_EQ(second[1].number, 2);
  EXPECT_EQ(ids_of(read_chunks(folder.path())), (std::vector<Ids>{{"a", "b"}, {"c"}, {"b"}}));
  EXPECT_EQ(read_chunk(folder.path(), 0).threads, 2);
  EXPECT_THROW(read_chunk(folder.path(), 3), InputError);
}

TEST(Chunks, AreCountedByWhatIsMissingOfTheNewestOnes) {
  const std::vector<Chunk> chunks = {{.number = 0, .cases = {"a", "b"}},
                                     {.number = 1, .cases = {"c"}},
                                     {.number = 2, .cases = {"b"}},
                                     {.number = 3, .cases = {"d"}},
                                     {.number = 4, .cases = {"e"}}};
  const ChunkCounts counts = count_chunks(chunks, {.queued = {2}, .running = {4}}, {"b", "d", "e"});
  EXPECT_EQ(counts.finished, 2);
  EXPECT_EQ(counts.queued, 1);
  EXPECT_EQ(counts.running, 1);
  EXPECT_EQ(counts.missing, 1);
}

TEST(Chunks, AskForMoreMemoryThanTheirRunsMayUse) {
  EXPECT_EQ(task_megabytes(0), 0u);
  EXPECT_GT(task_megabytes(1000u << 20), 1100u);
}

}  // namespace
}  // namespace ccdt::sweep
