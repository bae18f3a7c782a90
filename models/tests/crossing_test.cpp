#include <gtest/gtest.h>

#include "models/solids.h"
#include "models/tests/crossings.h"

namespace ccdt::testing {
namespace {

struct Case {
  std::string_view name;
  double edge_length;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name << " at " << c.edge_length;
}

TEST(Crossings, AreFoundWhereAnEdgePiercesATriangle) {
  const std::vector<Point3> vertices{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {9, 9, 0}};
  const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(crossings(vertices, triangles).size(), 1u);
}

TEST(Crossings, AreFoundWhereATriangleIsFoldedOntoItsNeighbor) {
  const std::vector<Point3> vertices{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}};
  const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {1, 0, 3}};
  EXPECT_EQ(crossings(vertices, triangles).size(), 1u);
}

class SolidSurface : public ::testing::TestWithParam<Case> {};

TEST_P(SolidSurface, DoesNotCrossItself) {
  const plc::InputPlc input = models::make_solid(GetParam().name, GetParam().edge_length);
  for (const auto& [a, b] : crossings(input.vertices, input.triangles)) {
    const Point3& at = input.vertices[input.triangles[a][0]];
    ADD_FAILURE() << "triangles " << a << " and " << b << " at " << at.x << " " << at.y << " " << at.z;
  }
}

INSTANTIATE_TEST_SUITE_P(Solids, SolidSurface,
                         ::testing::Values(Case{"piston", 16}, Case{"piston", 6}, Case{"piston", 2},
                                           Case{"bracket", 12}, Case{"bracket", 5}, Case{"bracket", 2},
                                           Case{"stepping-pole", 12}, Case{"stepping-pole", 4},
                                           Case{"stepping-pole", 1.5}, Case{"cube", 0.25}, Case{"sphere", 1.2},
                                           Case{"sphere", 0.2}, Case{"torus", 0.5}, Case{"torus", 0.1},
                                           Case{"graded-cube", 0.25}, Case{"rough-sphere", 0.2},
                                           Case{"schoenhardt", 0}));

}  // namespace
}  // namespace ccdt::testing
