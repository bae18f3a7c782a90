#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "baselines/external_program.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

using Json = nlohmann::json;

class SnakemakeSweep : public Program {
 protected:
  void SetUp() override {
    if (!baselines::find_on_path("snakemake"))
      GTEST_SKIP() << "Snakemake is not installed here; tools/setup test installs it";
    setenv("XDG_CACHE_HOME", (work() / "cache").c_str(), 1);
    write("spec.json", Json{{"schema", "ccdt.sweep/1"},
                            {"inputs", {{{"model", "cube"}, {"edge_length", {1, 0.5, 0.25}}}}},
                            {"options", {{"lattice", {"fcc", "bcc"}}, {"improve", "none"}}},
                            {"limits", {{"seconds", 60}, {"bytes", 1'000'000'000}}}}
                           .dump());
  }

  int snakemake() const {
    const int status = std::system(
        ("cd '" + work().string() + "' && snakemake -s out/Snakefile --cores 2 </dev/null >snakemake.log 2>&1")
            .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  Json status() const { return Json::parse(run("sweep spec.json -o out --status --json").out, nullptr, false); }
};

TEST_F(SnakemakeSweep, RunsTheChunks) {
  const Outcome written = run("sweep spec.json -o out --snakemake --chunk-minutes 0.0001");
  ASSERT_EQ(written.exit_code, 0) << written.err;
  EXPECT_EQ(status().at("missing"), 6);
  ASSERT_TRUE(std::filesystem::exists(work() / "out" / "chunks" / "1.json"));
  ASSERT_EQ(snakemake(), 0) << text_of(work() / "snakemake.log");
  EXPECT_EQ(status().at("finished"), 6);
  EXPECT_EQ(status().at("missing"), 0);
}

TEST_F(SnakemakeSweep, RunsAgainWhatHasBeenLost) {
  ASSERT_EQ(run("sweep spec.json -o out --snakemake").exit_code, 0);
  ASSERT_EQ(snakemake(), 0) << text_of(work() / "snakemake.log");
  std::filesystem::remove(std::filesystem::directory_iterator(work() / "out" / "runs")->path());
  ASSERT_EQ(run("sweep spec.json -o out --snakemake").exit_code, 0);
  EXPECT_EQ(status().at("missing"), 1);
  ASSERT_EQ(snakemake(), 0) << text_of(work() / "snakemake.log");
  EXPECT_EQ(status().at("missing"), 0);
}

}  // namespace
}  // namespace ccdt
