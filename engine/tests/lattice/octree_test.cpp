#include "engine/lattice/octree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "engine/lattice/inside_test.h"
#include "engine/tests/lattice/lattice_shapes.h"

namespace ccdt::test {
namespace {

lattice::Octree octree_of(const Shape& shape, double edge_length, double grading) {
  const lattice::DomainSurface surface = surface_of(shape);
  return lattice::build_octree(surface, lattice::target_sizes(surface, edge_length, grading), lattice::Lattice::fcc);
}

TEST(LatticeOctree, HasLevelsThatDifferByOneAtMost) {
  for (const Shape& shape : {cube_with_a_fine_corner(), sphere(3)}) {
    const lattice::Octree tree = octree_of(shape, 0, 2);  // growth as fast as the rule allows
    std::vector<lattice::OctreeNode> leaves;
    std::set<int> levels;
    for (const lattice::OctreeNode& node : tree.nodes) {
      if (!node.is_leaf() || node.place == lattice::NodePlace::outside) continue;
      leaves.push_back(node);
      levels.insert(node.level);
    }
    EXPECT_GE(levels.size(), 2u);
    for (const lattice::OctreeNode& a : leaves) {
      for (const lattice::OctreeNode& b : leaves) {
        if (squared_distance(tree.box(a), tree.box(b)) == 0) {
          ASSERT_LE(std::abs(a.level - b.level), 1);
        }
      }
    }
  }
}

TEST(LatticeOctree, LeavesFillTheRootOnce) {
  const lattice::Octree tree = octree_of(cube_with_a_fine_corner(), 0, 0.5);
  double volume = 0;
  for (const lattice::OctreeNode& node : tree.nodes) {
    if (node.is_leaf()) volume += std::pow(tree.side(node), 3);
  }
  EXPECT_EQ(volume, std::pow(tree.side(tree.nodes[0]), 3));
}

TEST(LatticeOctree, KnowsWhereItsNodesAre) {
  const auto tunnel = [](int x, int y, int) { return x == 2 && y == 2 ? 0 : 1; };
  for (bool turn : {false, true}) {
    const Shape shape = cubes(5, tunnel, turn);
    const lattice::Octree tree = octree_of(shape, 0.3 * shape.unit, 0);
    std::size_t inside = 0;
    for (const lattice::OctreeNode& node : tree.nodes) {
      if (!node.is_leaf() || node.place == lattice::NodePlace::surface) continue;
      const bool is_in = node.place == lattice::NodePlace::inside;
      ASSERT_NEAR(winding_number(shape, tree.box(node).center()), is_in ? 1 : 0, 1e-6);
      inside += is_in;
    }
    EXPECT_GT(inside, 0u);
  }
}

TEST(LatticeOctree, NodesOnTheSurfaceKnowAllTrianglesThatTouchThem) {
  const Shape shape = sphere(2);
  const lattice::Octree tree = octree_of(shape, 0, 0.5);
  for (const lattice::OctreeNode& node : tree.nodes) {
    const Box box = tree.box(node);
    const auto known = tree.triangles_of(node);
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
      Point3 common;
      if (node.place != lattice::NodePlace::surface && node.level > 0) {
        ASSERT_TRUE(known.empty());
      }
      if (lattice::common_point(box, surface_of(shape).corners(t), common)) {
        ASSERT_NE(std::ranges::find(known, t), known.end());
      }
    }
  }
}

TEST(LatticeOctree, LeavesAreAsLargeAsTheSizeFieldAllows) {
  const Shape shape = cube_with_a_fine_corner();
  for (double grading : {0.2, 0.5, 1.0}) {
    const lattice::Octree tree = octree_of(shape, 0, grading);
    const double longest = std::sqrt(2.0) * shape.unit, fine = std::sqrt(2.0) / 16 * shape.unit;
    const Point3 fine_place = shape.vertices.back();
    double largest = 0;
    for (const lattice::OctreeNode& node : tree.nodes) {
      if (!node.is_leaf() || node.place == lattice::NodePlace::outside) continue;
      const Box box = tree.box(node);
      const double edge_length = lattice::edge_length_of_cell(lattice::Lattice::fcc, tree.length(tree.side(node)));
      largest = std::max(largest, edge_length);
      const double allowed_by_fine = fine + grading * std::sqrt(squared_distance(box, fine_place));
      double to_vertex = HUGE_VAL;
      for (const Point3& v : shape.vertices) to_vertex = std::min(to_vertex, squared_distance(box, v));
      ASSERT_LE(edge_length, std::sqrt(2.0) * allowed_by_fine * 1.001);
      ASSERT_LE(edge_length, std::sqrt(2.0) * (longest + grading * std::sqrt(to_vertex)) * 1.001);
    }
    EXPECT_GE(largest, 1.1 * shape.unit);
  }
}

TEST(LatticeOctree, IsUniformWithoutGrading) {
  const Shape shape = cube_with_a_fine_corner();
  const double edge_length = 0.37 * shape.unit;
  const lattice::Octree tree = octree_of(shape, edge_length, 0);
  for (const lattice::OctreeNode& node : tree.nodes) {
    if (!node.is_leaf() || node.place == lattice::NodePlace::outside) continue;
    ASSERT_NEAR(lattice::edge_length_of_cell(lattice::Lattice::fcc, tree.length(tree.side(node))) / edge_length, 1,
                0.004);
  }
}

TEST(InsideByRays, TellsTheSideAndDeclinesPointsOfTheSurface) {
  const double u = 1024;
  const std::vector<Point3> vertices = {{0, 0, 0}, {u, 0, 0}, {0, u, 0}, {u, u, 0}};
  const std::vector<lattice::SurfaceTriangle> triangles = {{{VertexId(0), VertexId(1), VertexId(2)}, true, false},
                                                           {{VertexId(1), VertexId(3), VertexId(2)}, true, false}};
  const lattice::DomainSurface surface{vertices, triangles, {}};
  const Box box{{-u, -u, -u}, {2 * u, 2 * u, u}};
  const std::uint32_t both[] = {0, 1};
  EXPECT_EQ(lattice::is_inside_by_rays({100, 100, 50}, box, surface, both), std::optional(true));
  EXPECT_EQ(lattice::is_inside_by_rays({100, 100, -50}, box, surface, both), std::optional(false));
  EXPECT_FALSE(lattice::is_inside_by_rays({512, 512, 0}, box, surface, both).value_or(false));  // on the common edge
  EXPECT_FALSE(lattice::is_inside_by_rays({100, 100, 0}, box, surface, both).value_or(false));  // within a triangle
  EXPECT_FALSE(lattice::is_inside_by_rays({0, 0, 0}, box, surface, both).value_or(false));      // on a vertex
  EXPECT_EQ(lattice::is_inside_by_rays({100, 100, 50}, box, surface, {}), std::nullopt);
}

TEST(InsideByRays, TakesTheNearestOfSeveralSheets) {
  const double u = 1024;
  std::vector<Point3> vertices;
  std::vector<lattice::SurfaceTriangle> triangles;
  std::vector<std::uint32_t> all;
  for (int sheet = 0; sheet < 4; ++sheet) {  // the domain between sheets 0 and 1, 2 and 3
    const double z = 100 * sheet;
    vertices.insert(vertices.end(), {{-9 * u, -9 * u, z}, {9 * u, -8 * u, z}, {0, 9 * u, z}});
    triangles.push_back(
        {{VertexId(3 * sheet), VertexId(3 * sheet + 1), VertexId(3 * sheet + 2)}, sheet % 2 == 0, sheet % 2 == 1});
    all.push_back(static_cast<std::uint32_t>(sheet));
  }
  const lattice::DomainSurface surface{vertices, triangles, {}};
  const Box box{{-u, -u, -u}, {u, u, u}};
  const double heights[] = {-50, 50, 150, 250, 350};
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(lattice::is_inside_by_rays({3, 5, heights[i]}, box, surface, all), std::optional(i % 2 == 1))
        << heights[i];
}

}  // namespace
}  // namespace ccdt::test
