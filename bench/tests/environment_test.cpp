#include "bench/run/environment.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
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

TEST(Environment, KnowsTheMemoryOfTheMachine) {
  EXPECT_GT(bench::capture_environment().memory_bytes, bench::peak_rss_bytes());
}

TEST(Environment, InJsonLacksWhatTheSystemDoesNotSay) {
  bench::Environment environment = bench::capture_environment();
  environment.governor = "";
  environment.temperature_celsius = {};
  bench::Json json = environment;
  for (const char* name : {"governor", "temperature_celsius", "jobs"}) EXPECT_FALSE(json.contains(name)) << name;
  EXPECT_FALSE(json.get<bench::Environment>().temperature_celsius);
  environment.governor = "performance";
  environment.temperature_celsius = 61.5;
  environment.jobs = 3;
  json = environment;
  EXPECT_EQ(json.get<bench::Environment>().governor, "performance");
  EXPECT_EQ(json.get<bench::Environment>().temperature_celsius, 61.5);
  EXPECT_EQ(json.get<bench::Environment>().jobs, 3);
  json.erase("memory_bytes");
  EXPECT_EQ(json.get<bench::Environment>().memory_bytes, 0u) << "of an older program";
}

/// A folder like those of the kernel, whose files contain one value each.
class Sensors : public testing::Test {
 protected:
  ~Sensors() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& file, const std::string& value) const {
    std::filesystem::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << value << "\n";
  }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "ccdt-sensors";
};

TEST_F(Sensors, GiveTheHottestOfZonesAndProcessors) {
  EXPECT_FALSE(bench::hottest_celsius(folder_)) << "there is no such folder";
  write("thermal/thermal_zone0/temp", "41000");
  write("thermal/cooling_device0/temp", "99000");
  EXPECT_EQ(bench::hottest_celsius(folder_), 41);
  write("hwmon/hwmon2/temp1_label", "Composite");  // of a disk
  write("hwmon/hwmon2/temp1_input", "88000");
  EXPECT_EQ(bench::hottest_celsius(folder_), 41);
  write("hwmon/hwmon3/temp1_label", "Package id 0");
  write("hwmon/hwmon3/temp1_input", "63500");
  EXPECT_EQ(bench::hottest_celsius(folder_), 63.5);
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
