#include <gtest/gtest.h>

#include <string>

#include "engine/base/work.h"
#include "engine/io/files.h"

namespace ccdt::gate {
namespace {

TEST(GateDocsTest, EveryWorkCountIsExplained) {
  const std::string docs = io::read_whole_file(std::filesystem::path(CCDT_SOURCE_DIR) / "docs/gates.md").bytes;
  for (const WorkCount& count : work_counts)
    EXPECT_NE(docs.find("| `" + std::string(count.name) + "` |"), std::string::npos) << count.name;
}

}  // namespace
}  // namespace ccdt::gate
