#include "bench/results/compact_mesh.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bench/results/kept_mesh.h"
#include "bench/tests/grid_mesh.h"

namespace ccdt {
namespace {

TEST(PackedBytes, AreUnpackedAgain) {
  for (const std::string& bytes :
       {std::string(), std::string("a"), std::string(100000, 'x'), std::string("\0\xff ab", 5)})
    EXPECT_EQ(results::unpacked(results::packed(bytes.data(), bytes.size())), bytes);
  EXPECT_THROW(results::unpacked("!"), std::runtime_error);
}

}  // namespace
}  // namespace ccdt
