#include "baselines/mesher_input.h"

#include <gtest/gtest.h>

#include "baselines/tests/shapes.h"
#include "engine/base/digits.h"

namespace ccdt {
namespace {

TEST(MergeEqualVertices, MakesARepeatedVertexOne) {
  const InputPlc merged = baselines::merge_equal_vertices(shapes::with_repeated_vertices(shapes::cube()));
  EXPECT_EQ(merged.vertices.size(), 8u);
  EXPECT_EQ(merged.triangles.size(), 12u);
}

TEST(MergeEqualVertices, KeepsTheOrderAndTakesMinusZeroForZero) {
  InputPlc plc;
  plc.vertices = {{1, 0, 0}, {0, 0, 0}, {1, -0.0, 0}, {2, 0, 0}};
  plc.triangles = {{2, 1, 3}};
  plc.segments = {{0, 3}};
  const InputPlc merged = baselines::merge_equal_vertices(plc);
  ASSERT_EQ(merged.vertices.size(), 3u);
  EXPECT_EQ(merged.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(merged.segments[0], (std::array<std::uint32_t, 2>{0, 2}));
}

TEST(MedianEdgeLength, OfACubeIsItsSideAndWithoutFacetsZero) {
  EXPECT_EQ(baselines::median_edge_length(shapes::cube()), 1);
  EXPECT_EQ(baselines::median_edge_length({}), 0);
}

TEST(Digits, ReadBackBitForBit) {
  EXPECT_EQ(std::stod(digits(0.1)), 0.1);
}

}  // namespace
}  // namespace ccdt
