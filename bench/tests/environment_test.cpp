#include "bench/environment.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <vector>

namespace ccdt {
namespace {

TEST(Environment, SaysWhereAndWithWhatARunWasMade) {
  const bench::Environment environment = bench::capture_environment();
  EXPECT_GE(environment.cores, 1u);
  EXPECT_NE(environment.compiler, "");
  EXPECT_NE(environment.flags.find("-ffp-contract=off"), std::string::npos);
  EXPECT_NE(environment.revision, "");
  EXPECT_TRUE(environment.libraries.contains("boost"));
}

TEST(Environment, PeakMemoryGrowsWithWhatIsUsed) {
  const std::uint64_t before = bench::peak_rss_bytes();
  const std::vector<char> used(before + (64 << 20), 'x');
  EXPECT_GE(bench::peak_rss_bytes(), before + (32u << 20)) << used.back();
}

TEST(Sha256, OfAFileIsThatOfItsBytes) {
  const auto file = std::filesystem::path(testing::TempDir()) / "ccdt-sha256-abc";
  std::ofstream(file) << "abc";  // the first example of FIPS 180-2
  EXPECT_EQ(bench::sha256_of_file(file), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  std::filesystem::remove(file);
}

TEST(Sha256, OfNoFileIsEmpty) {
  EXPECT_EQ(bench::sha256_of_file("/nowhere/nothing"), "");
  EXPECT_EQ(bench::sha256_of_file(testing::TempDir()), "");
}

}  // namespace
}  // namespace ccdt
