#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "engine/base/index_lists.h"
#include "engine/delaunay/delaunay.h"
#include "engine/geometry/predicates.h"
#include "engine/locate/grid_locator.h"
#include "engine/locate/octree_locator.h"

namespace ccdt {
namespace {

constexpr double side = 0x1p40;

/// Vertices and the small triangles that they form. If graded, distances to a point span many powers of two.
struct Scene {
  std::vector<delaunay::DelaunayVertex> vertices;
  std::vector<std::array<VertexId, 3>> triangles;

  Scene(std::uint32_t count, bool graded, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(-1, 1), power(0, 25);
    std::vector<Point3> centers;
    while (vertices.size() + 3 <= count) {
      const double scale = side * (graded ? std::exp2(-power(random)) : 1);
      const Point3 center{scale * part(random), scale * part(random), scale * part(random)};
      for (int i = 0; i < 3; ++i) {
        const Point3 p = center + (0.3 * scale) * Point3{part(random), part(random), part(random)};
        vertices.push_back({{std::round(p.x), std::round(p.y), std::round(p.z)}, 0});
      }
      const auto n = static_cast<std::uint32_t>(vertices.size());
      triangles.push_back({VertexId(n - 3), VertexId(n - 2), VertexId(n - 1)});
    }
  }

  const Point3& corner(std::size_t triangle, int i) const { return vertices[triangles[triangle][i]].point; }
};

/// Do the closed segment and the closed triangle have a point in common? (Touching in one plane may count as well.)
bool passes(const Point3& p, const Point3& q, const Point3& a, const Point3& b, const Point3& c) {
  if (orient3d(a, b, c, p) * orient3d(a, b, c, q) > 0) return false;
  const std::array turns = {orient3d(p, q, a, b), orient3d(p, q, b, c), orient3d(p, q, c, a)};
  return std::none_of(turns.begin(), turns.end(), [](int t) { return t < 0; }) ||
         std::none_of(turns.begin(), turns.end(), [](int t) { return t > 0; });
}

bool is_corner(const Scene& scene, std::size_t triangle, const Point3& p) {
  return scene.corner(triangle, 0) == p || scene.corner(triangle, 1) == p || scene.corner(triangle, 2) == p;
}

template <class Locator>
void expect_vertices_of_caps(const Scene& scene, const Locator& locator, unsigned seed) {
  std::mt19937 random(seed);
  for (int round = 0; round < 40; ++round) {
    const std::size_t t = random() % scene.triangles.size();
    const Point3 &a = scene.corner(t, 0), &b = scene.corner(t, 1), &c = scene.corner(t, 2);
    locate::Cap cap(a, b, c);
    // It shrinks to a ball around a vertex after some visits, as it does when a candidate is found.
    const Point3 center = scene.vertices[random() % scene.vertices.size()].point;
    const double radius = std::sqrt(squared_length(center - a)) * (round % 4 + 1) / 4;
    const unsigned visits_before = random() % 3 == 0 ? 1000000 : random() % 20;
    std::vector<int> visits(scene.vertices.size(), 0);
    unsigned count = 0;
    locator.visit_nearest_first(a, cap, [&](const locate::LocatedVertex& v) {
      EXPECT_TRUE(v.point == scene.vertices[v.id].point);
      ++visits[v.id];
      if (count++ == visits_before) cap.shrink_to(center, radius);
    });
    for (std::size_t v = 0; v < visits.size(); ++v) {
      EXPECT_LE(visits[v], 1);
      EXPECT_TRUE(visits[v] == 1 || !cap.may_hold(scene.vertices[v].point));
    }
  }
}

template <class Locator>
void expect_faces_of_edges(const Scene& scene, const Locator& locator, unsigned seed) {
  std::mt19937 random(seed);
  std::size_t passed = 0;
  for (int round = 0; round < 200; ++round) {
    const Point3 p = scene.vertices[random() % scene.vertices.size()].point,
                 q = scene.vertices[random() % scene.vertices.size()].point;
    if (p == q) continue;
    std::set<std::uint32_t> visited;
    EXPECT_FALSE(locator.any_near_edge(p, q, [&](std::uint32_t f) {
      visited.insert(f);
      return false;
    }));
    for (std::uint32_t f = 0; f < scene.triangles.size(); ++f) {
      if (!passes(p, q, scene.corner(f, 0), scene.corner(f, 1), scene.corner(f, 2))) continue;
      passed += !is_corner(scene, f, p) && !is_corner(scene, f, q);
      EXPECT_TRUE(visited.count(f));
      int calls_after = 0;
      bool found = false;
      EXPECT_TRUE(locator.any_near_edge(p, q, [&](std::uint32_t g) {
        calls_after += found;
        found = found || g == f;
        return found;
      }));
      EXPECT_EQ(calls_after, 0);
    }
  }
  EXPECT_TRUE(passed > 200 || scene.triangles.size() < 1000) << passed;  // not only the triangles at the ends
}

/// \param make  makes a locator of a scene
template <class Make>
void expect_finds_everything(const Make& make) {
  for (const bool graded : {false, true})
    for (const std::uint32_t count : {3u, 30u, 3000u}) {
      SCOPED_TRACE(std::to_string(count) + (graded ? " graded" : " even"));
      const Scene scene(count, graded, count);
      const auto locator = make(scene);
      expect_vertices_of_caps(scene, locator, 1);
      if (count > 3) expect_faces_of_edges(scene, locator, 2);
    }
}

TEST(GridLocator, FindsAllVerticesAndFacesAtAnyScale) {
  for (const double scale : {0.5, 1.0, 3.0})
    expect_finds_everything([&](const Scene& s) { return locate::GridLocator(s.vertices, s.triangles, scale); });
}

TEST(OctreeLocator, FindsAllVerticesAndFaces) {
  expect_finds_everything([](const Scene& s) { return locate::OctreeLocator(s.vertices, s.triangles); });
}

TEST(OctreeLocator, OfSomeFindsTheseAlone) {
  const Scene scene(3000, true, 5);
  std::vector<std::uint32_t> some_vertices, some_faces;
  for (std::uint32_t v = 0; v < scene.vertices.size(); v += 7) some_vertices.push_back(v);
  for (std::uint32_t f = 0; f < scene.triangles.size(); f += 5) some_faces.push_back(f);
  const locate::OctreeLocator locator(scene.vertices, some_vertices, scene.triangles, {}, some_faces);
  const locate::Cap cap(scene.corner(0, 0), scene.corner(0, 1), scene.corner(0, 2));
  locator.visit_nearest_first({}, cap, [](const locate::LocatedVertex& v) { EXPECT_EQ(v.id % 7, 0u); });
  int faces = 0;
  locator.any_near_edge({-side, -side, -side}, {side, side, side}, [&](std::uint32_t f) {
    EXPECT_EQ(f % 5, 0u);
    ++faces;
    return false;
  });
  EXPECT_GT(faces, 0);
}

TEST(OctreeLocator, HoldsManyVerticesInOnePlace) {
  Scene scene(30, false, 6);
  for (std::uint32_t i = 0; i < 100; ++i) scene.vertices.push_back({{side + i % 3, 0, 0}, 0});
  expect_vertices_of_caps(scene, locate::OctreeLocator(scene.vertices, scene.triangles), 7);
}

TEST(OctreeLocator, OfNothingFindsNothing) {
  const locate::OctreeLocator locator({}, {});
  locator.visit_nearest_first({}, locate::Cap({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                              [](const locate::LocatedVertex&) { ADD_FAILURE(); });
  EXPECT_FALSE(locator.any_near_edge({0, 0, 0}, {1, 1, 1}, [](std::uint32_t) { return true; }));
}

/// Oblique square plates, stacked with very small gaps, with a facet on each.
struct Stack : Scene {
  static constexpr std::uint32_t plates = 6, steps = 20;
  std::vector<FacetId> facets;

  Stack() : Scene(0, false, 0) {
    const Point3 along{0.6 * side, 0.8 * side, 0}, across{-0.48 * side, 0.36 * side, 0.8 * side}, up{8000, -6000, 7500};
    constexpr std::uint32_t row = steps + 1;
    for (std::uint32_t plate = 0; plate < plates; ++plate) {
      for (std::uint32_t i = 0; i < row * row; ++i) {
        const Point3 p =
            static_cast<double>(plate) * up + (1.0 / steps * (i % row)) * along + (1.0 / steps * (i / row)) * across;
        vertices.push_back({{std::round(p.x), std::round(p.y), std::round(p.z)}, 0});
      }
      for (std::uint32_t i = 0; i < steps * steps; ++i) {
        const std::uint32_t v = plate * row * row + i / steps * row + i % steps;
        triangles.push_back({VertexId(v), VertexId(v + 1), VertexId(v + row)});
        triangles.push_back({VertexId(v + 1), VertexId(v + row + 1), VertexId(v + row)});
      }
      facets.resize(triangles.size(), FacetId(plate));
    }
  }
};

TEST(OctreeLocator, FindsAllFacesOfFacets) {
  const Stack stack;
  expect_faces_of_edges(
      stack,
      locate::OctreeLocator(stack.vertices, {}, stack.triangles, stack.facets, all_indices(stack.triangles.size())), 9);
  for (const bool graded : {false, true}) {
    const Scene scene(3000, graded, 10);
    std::vector<FacetId> facets;
    for (std::uint32_t f = 0; f < scene.triangles.size(); ++f) facets.push_back(FacetId(f % 9 * f % 10));
    expect_faces_of_edges(
        scene, locate::OctreeLocator(scene.vertices, {}, scene.triangles, facets, all_indices(scene.triangles.size())),
        11);
  }
}

/// Edges between thin plates meet the boxes of many faces, but only those at their ends can be in the way.
TEST(OctreeLocator, VisitsFewFacesBetweenThinPlates) {
  const Stack stack;
  const locate::OctreeLocator locator(stack.vertices, {}, stack.triangles, stack.facets,
                                      all_indices(stack.triangles.size()));
  const std::size_t of_plate = stack.vertices.size() / Stack::plates;
  std::size_t visits = 0;
  for (std::size_t i = 0; i < of_plate; ++i)
    locator.any_near_edge(stack.vertices[2 * of_plate + i].point, stack.vertices[4 * of_plate - 1 - i].point,
                          [&](std::uint32_t) {
                            ++visits;
                            return false;
                          });
  EXPECT_LT(visits / of_plate, 20u);
}

/// With a coarse grid or an octree, few vertices are visited when the cap is small: that is what locators are for.
TEST(Locators, VisitFewVerticesWhereTheCapIsSmall) {
  const Scene scene(30000, false, 8);
  const auto visits_of = [&](const auto& locator) {
    std::size_t visits = 0;
    for (std::size_t t = 0; t < 100; ++t) {
      locate::Cap cap(scene.corner(t, 0), scene.corner(t, 1), scene.corner(t, 2));
      cap.shrink_to(scene.corner(t, 0), side / 16);
      locator.visit_nearest_first(scene.corner(t, 0), cap, [&](const locate::LocatedVertex&) { ++visits; });
    }
    return visits / 100;
  };
  EXPECT_LT(visits_of(locate::GridLocator(scene.vertices, scene.triangles)), 200u);
  EXPECT_LT(visits_of(locate::OctreeLocator(scene.vertices, scene.triangles)), 200u);
}

}  // namespace
}  // namespace ccdt
