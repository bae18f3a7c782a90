#include "engine/front/visibility.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <vector>

#include "engine/front/find_apex.h"
#include "engine/geometry/predicates.h"
#include "engine/locate/grid_locator.h"

// Triangles that may cross, and vertices that they hide: in grid units, so that every sign is exact.

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

/// A face and a wall between it and vertex 6. The edges of the wall pass through the middles of the straight edges from
/// the face to vertex 6, and its corners are outside the sphere of the face and that vertex.
struct Wall {
  delaunay::Delaunay delaunay = delaunay::build_delaunay(std::vector<Point3>{
      {0, 0, 0}, {600, 0, 0}, {0, 600, 0}, {700, 700, 100}, {300, -100, 100}, {-100, 300, 100}, {200, 200, 200}});
  facets::FacetMesh facets;

  Wall() {
    for (const auto& [a, b, c] : std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {3, 4, 5}}) {
      facets.facet.emplace_back(static_cast<std::uint32_t>(facets.triangles.size()));
      facets.triangles.push_back({VertexId(a), VertexId(b), VertexId(c)});
    }
  }
  const Point3& point(std::uint32_t v) const { return delaunay.vertices[v].point; }
};

TEST(FindApexAsPaper, SeesAWallThatTouchesTheThreeTrianglesAndCrossesNone) {
  const Wall wall;
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 0)})
    EXPECT_FALSE(cross({wall.point(a), wall.point(b), wall.point(6)}, {wall.point(3), wall.point(4), wall.point(5)}));
  for (const std::uint32_t v : {3, 4, 5})
    EXPECT_LT(insphere(wall.point(0), wall.point(1), wall.point(2), wall.point(6), wall.point(v)), 0);
  const locate::GridLocator grid(wall.delaunay.vertices, wall.facets.triangles);
  const auto apex = find_apex_as_in_paper(grid, wall.facets, wall.delaunay, {0, 1, 2});
  EXPECT_EQ(apex, find_apex(grid, wall.facets, wall.delaunay, {0, 1, 2}));
  ASSERT_TRUE(apex.has_value());
  EXPECT_NE(*apex, 6u);
}

}  // namespace
}  // namespace ccdt::front
