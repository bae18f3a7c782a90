#include "engine/front/visibility.h"

#include <gtest/gtest.h>

#include <array>

// Triangles that may cross: in grid units, so that every sign is exact.

namespace ccdt::front {
namespace {

using Triangle = std::array<Point3, 3>;

const Triangle base = {{{0, 0, 0}, {6, 0, 0}, {0, 6, 0}}};

bool cross(const Triangle& s, const Triangle& t) {
  const auto corners = [](const Triangle& x) { return Corners{&x[0], &x[1], &x[2]}; };
  const bool result = cross_each_other(corners(s), corners(t));
  EXPECT_EQ(result, cross_each_other(corners(t), corners(s)));
  EXPECT_EQ(result, cross_each_other(corners({s[1], s[0], s[2]}), corners({t[2], t[0], t[1]})));
  return result;
}

TEST(CrossEachOther, WhenAnEdgePassesThroughTheInside) {
  EXPECT_TRUE(cross(base, {{{1, 1, -1}, {1, 1, 1}, {9, 9, 9}}}));
  EXPECT_TRUE(cross(base, {{{1, 1, -1}, {1, 2, -1}, {1, 1, 5}}})) << "both triangles' planes are oblique to the axes";
}

TEST(CrossEachOther, WhenOneSharedCornerIsAllThatTheyHaveInCommonOtherwise) {
  EXPECT_TRUE(cross(base, {{{0, 0, 0}, {3, 2, -1}, {2, 3, 1}}}));
  EXPECT_FALSE(cross(base, {{{0, 0, 0}, {3, 2, 1}, {2, 3, 2}}}));
}

TEST(CrossEachOther, NotWhereTheyOnlyTouch) {
  EXPECT_FALSE(cross(base, {{{1, 1, 0}, {1, 1, 5}, {2, 1, 5}}})) << "a corner in the other's inside";
  EXPECT_FALSE(cross(base, {{{3, 0, -1}, {3, 0, 1}, {3, -5, 0}}})) << "an edge through an edge";
  EXPECT_FALSE(cross(base, {{{1, 1, 0}, {2, 1, 0}, {1, 1, 5}}})) << "an edge in the other's inside";
  EXPECT_FALSE(cross(base, {{{0, 0, 0}, {6, 0, 0}, {0, 0, 6}}})) << "a common edge";
  EXPECT_FALSE(cross(base, {{{0, 0, -1}, {0, 0, 1}, {-5, -5, 0}}})) << "an edge through a corner";
}

TEST(CrossEachOther, NotInOnePlaneNorApart) {
  EXPECT_FALSE(cross(base, {{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}}));
  EXPECT_FALSE(cross(base, {{{5, 5, -1}, {5, 5, 1}, {9, 9, 0}}}));
  EXPECT_FALSE(cross(base, {{{1, 1, 1}, {2, 1, 1}, {1, 2, 2}}}));
  EXPECT_FALSE(cross(base, {{{7, 0, -1}, {7, 0, 1}, {8, 1, 0}}})) << "it meets the plane beside the triangle";
}

}  // namespace
}  // namespace ccdt::front
