#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "engine/base/errors.h"
#include "engine/geometry/balls.h"
#include "engine/geometry/closest_point.h"
#include "engine/lattice/clear_sites.h"
#include "engine/lattice/octree.h"
#include "engine/lattice/place_lattice_points.h"
#include "engine/tests/lattice/lattice_shapes.h"

namespace ccdt::test {
namespace {

bool before(const Point3& a, const Point3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

std::vector<Point3> sorted(std::vector<Point3> points) {
  std::ranges::sort(points, before);
  return points;
}

/// Is p in the smallest sphere of a triangle? Uses a formula other than the engine's.
bool in_smallest_sphere(const Point3& a, const Point3& b, const Point3& c, const Point3& p) {
  const double la = squared_length(b - c), lb = squared_length(c - a), lc = squared_length(a - b);
  const auto in_diametral = [&p](const Point3& u, const Point3& v) { return dot(u - p, v - p) <= 0; };
  if (la >= lb + lc) return in_diametral(b, c);
  if (lb >= lc + la) return in_diametral(c, a);
  if (lc >= la + lb) return in_diametral(a, b);
  const double wa = la * (lb + lc - la), wb = lb * (lc + la - lb), wc = lc * (la + lb - lc), sum = wa + wb + wc;
  const Point3 center = (wa / sum) * a + (wb / sum) * b + (wc / sum) * c;
  return squared_length(p - center) <= squared_length(a - center);
}

void expect_inside(const Shape& shape, const std::vector<Point3>& points) {
  ASSERT_FALSE(points.empty());
  for (const Point3& p : points) ASSERT_NEAR(winding_number(shape, p), 1, 1e-6) << p.x << " " << p.y << " " << p.z;
}

void expect_outside_of_smallest_spheres(const Shape& shape, const std::vector<Point3>& points) {
  for (const lattice::SurfaceTriangle& t : shape.triangles) {
    for (const Point3& p : points)
      ASSERT_FALSE(in_smallest_sphere(shape.vertices[t.vertices[0]], shape.vertices[t.vertices[1]],
                                      shape.vertices[t.vertices[2]], p));
  }
  for (const auto& [a, b] : shape.subsegments) {
    for (const Point3& p : points) ASSERT_GT(dot(shape.vertices[a] - p, shape.vertices[b] - p), 0);
  }
}

int l_shape(int x, int y, int) {
  return x < 4 || y < 4 ? 1 : 0;
}

TEST(LatticePoints, AreStrictlyInsideAndOutsideOfAllSmallestSpheres) {
  const Shape shapes[] = {cube(8), cube(6, true), sphere(3), cubes(9, l_shape), cubes(8, l_shape, true)};
  for (const Shape& shape : shapes) {
    for (lattice::Lattice kind : lattices) {
      for (double grading : {0.0, 0.5}) {
        const auto points = shape.place({kind, 0, grading});
        expect_inside(shape, points);
        expect_outside_of_smallest_spheres(shape, points);
      }
    }
  }
}

TEST(LatticePoints, AreIntegersAndPairwiseDifferent) {
  for (lattice::Lattice kind : lattices) {
    const auto points = sorted(sphere(3).place({kind, 0, 0.3}));
    EXPECT_EQ(std::ranges::adjacent_find(points), points.end());
    for (const Point3& p : points) {
      for (double c : as_array(p)) ASSERT_EQ(c, std::round(c));
    }
  }
}

TEST(LatticePoints, ShareManyTrailingZeroBitsWhenUniform) {
  for (lattice::Lattice kind : lattices) {
    for (double edge_length : {0.31, 0.7, 1.0}) {
      const Shape shape = cube(10, true);
      for (const Point3& p : shape.place({kind, edge_length * shape.unit, 0})) {
        for (double c : as_array(p)) ASSERT_EQ(std::fmod(c, std::ldexp(1.0, 34)), 0);
      }
    }
  }
}

TEST(LatticePoints, DoNotDependOnTheOrderOfTriangles) {
  Shape shape = cubes(7, l_shape, true);
  const auto points = shape.place({lattice::Lattice::fcc, 0, 0.5});
  EXPECT_EQ(points, shape.place({lattice::Lattice::fcc, 0, 0.5}));
  std::ranges::reverse(shape.triangles);
  for (lattice::SurfaceTriangle& t : shape.triangles) {
    std::swap(t.vertices[0], t.vertices[1]);
    std::swap(t.inside_above, t.inside_below);
  }
  EXPECT_EQ(points, shape.place({lattice::Lattice::fcc, 0, 0.5}));
}

TEST(LatticePoints, AreMissingOnlyOutsideOrNearTheSurface) {
  for (const Shape& shape : {cubes(8, l_shape, true), sphere(3)}) {
    const double edge_length = 0.16 * shape.unit * (shape.triangles.size() == 1280 ? 1 : 4);
    const auto points = sorted(shape.place({lattice::Lattice::sc, edge_length, 0}));
    ASSERT_GT(points.size(), 300u);
    const double side = lattice::round_to_few_bits(lattice::cell_side(lattice::Lattice::sc, edge_length));
    std::size_t missing = 0;
    for (const Point3& p : points) {
      for (const Point3& step :
           {Point3{side, 0, 0}, {-side, 0, 0}, {0, side, 0}, {0, -side, 0}, {0, 0, side}, {0, 0, -side}}) {
        const Point3 q = p + step;
        if (std::ranges::binary_search(points, q, before)) continue;
        ++missing;
        if (std::abs(winding_number(shape, q)) < 0.5) continue;
        const bool near = std::ranges::any_of(shape.triangles, [&](const lattice::SurfaceTriangle& t) {
          const lattice::TrianglePoints c{shape.vertices[t.vertices[0]], shape.vertices[t.vertices[1]],
                                          shape.vertices[t.vertices[2]]};
          return in_smallest_sphere(c[0], c[1], c[2], q) ||
                 std::sqrt(squared_distance(c, q)) < 1.01 * lattice::usual_clearance * edge_length;
        });
        ASSERT_TRUE(near) << q.x << " " << q.y << " " << q.z;
      }
    }
    EXPECT_GT(missing, 0u);
  }
}

/// How many points are next to p, and how far they are.
struct Neighbors {
  int count = 0;
  double distance = HUGE_VAL;
};

Neighbors nearest(const std::vector<Point3>& points, const Point3& p) {
  Neighbors found;
  for (const Point3& q : points) {
    if (q == p) continue;
    const double distance = std::sqrt(squared_length(q - p));
    if (distance < 0.999 * found.distance)
      found = {1, distance};
    else if (distance < 1.001 * found.distance)
      ++found.count;
  }
  return found;
}

TEST(LatticePoints, HaveTheNeighborsOfTheirLattice) {
  struct Case {
    lattice::Lattice kind;
    int neighbors;
    double distance;
  };
  const Shape shape = cube(10);
  const double edge_length = 0.97 * shape.unit;
  for (const Case& c : {Case{lattice::Lattice::fcc, 12, 1.0},
                        {lattice::Lattice::bcc, 8, 0.97208},
                        {lattice::Lattice::sc, 6, 0.89090}}) {
    const auto points = shape.place({c.kind, edge_length, 0});
    int inner = 0;
    for (const Point3& p : points) {
      if (squared_length(p) > std::pow(2.5 * edge_length, 2)) continue;
      ++inner;
      const Neighbors found = nearest(points, p);
      EXPECT_EQ(found.count, c.neighbors);
      EXPECT_NEAR(found.distance / edge_length, c.distance, 0.004);
    }
    EXPECT_GT(inner, 50);
  }
}

/// Points per volume within a window that fades to nothing at its border, so that whole layers neither enter nor leave.
double density(const std::vector<Point3>& points, double half_side) {
  double sum = 0;
  for (const Point3& p : points) {
    double weight = 1;
    for (double c : as_array(p)) weight *= std::abs(c) < half_side ? 1 + std::cos(std::numbers::pi * c / half_side) : 0;
    sum += weight;
  }
  return sum / std::pow(2 * half_side, 3);
}

TEST(LatticePoints, HaveTheSameDensityInAllLattices) {
  const Shape shape = cube(4);
  for (double part : {0.21, 0.25, 0.3, 0.37}) {
    const double edge_length = part * shape.unit, wanted = std::sqrt(2.0) / std::pow(edge_length, 3);
    for (lattice::Lattice kind : lattices)
      EXPECT_NEAR(density(shape.place({kind, edge_length, 0}), 0.9 * shape.unit) / wanted, 1, 0.02);
  }
}

TEST(LatticePoints, KeepTheirDistanceFromTheSurface) {
  const Shape shape = cube(10);
  for (lattice::Lattice kind : lattices) {
    const double edge_length = 0.6 * shape.unit;
    double least = HUGE_VAL;
    for (const Point3& p : shape.place({kind, edge_length, 0})) {
      for (double c : as_array(p)) least = std::min(least, 5 * shape.unit - std::abs(c));
    }
    EXPECT_GE(least, 0.99 * lattice::usual_clearance * edge_length);
    EXPECT_LE(least, 1.5 * edge_length);
  }
}

TEST(LatticePoints, AreNotInAHole) {
  const Shape shape = cubes(9, [](int x, int y, int z) {
    const auto middle = [](int c) { return c >= 3 && c < 6; };
    return middle(x) && middle(y) && middle(z) ? 0 : 1;
  });
  const auto points = shape.place({lattice::Lattice::fcc, 0.5 * shape.unit, 0});
  expect_inside(shape, points);
  for (const Point3& p : points) {
    const auto c = as_array(p);
    ASSERT_TRUE(std::ranges::any_of(c, [&](double x) { return std::abs(x) > 1.5 * shape.unit; }));
  }
}

TEST(LatticePoints, AreOnBothSidesOfAnInteriorFacet) {
  const auto halves = [](int x, int, int) { return x < 4 ? 1 : 2; };
  const Shape one = cube(9), two = cubes(9, halves);
  const double facet = -0.5 * one.unit, edge_length = 0.5 * one.unit;
  const auto all = sorted(one.place({lattice::Lattice::bcc, edge_length, 0}));
  const auto divided = sorted(two.place({lattice::Lattice::bcc, edge_length, 0}));
  EXPECT_LT(divided.size(), all.size());
  EXPECT_TRUE(std::ranges::includes(all, divided, before));
  std::size_t lost = 0;
  for (const Point3& p : all) {
    if (std::ranges::binary_search(divided, p, before)) continue;
    ++lost;
    // Half the diagonal of a square of the facet is the largest radius of a sphere.
    ASSERT_LE(std::abs(p.x - facet), std::sqrt(0.5) * one.unit * 1.001);
  }
  EXPECT_EQ(lost, all.size() - divided.size());
}

TEST(LatticePoints, StayClearOfDanglingFacetsSegmentsAndVertices) {
  Shape shape = cube(8);
  const auto add = [&shape](double x, double y, double z) {
    shape.vertices.push_back(shape.unit * Point3{x, y, z});
    return VertexId(shape.vertices.size() - 1);
  };
  const VertexId a = add(1, 1, 1), b = add(2, 1, 1), c = add(1, 2, 1);
  shape.triangles.push_back({{a, b, c}, true, true});
  const VertexId d = add(-2, -1.5, -1), e = add(-1, -1.5, -1), alone = add(-1, 2, 0.125);
  shape.subsegments.push_back({d, e});
  const double edge_length = 0.4 * shape.unit;
  const auto points = shape.place({lattice::Lattice::fcc, edge_length, 0});
  expect_inside(shape, points);
  expect_outside_of_smallest_spheres(shape, points);
  double least = HUGE_VAL;
  for (const Point3& p : points) least = std::min(least, std::sqrt(squared_length(p - shape.vertices[alone])));
  EXPECT_GE(least, 0.99 * lattice::usual_clearance * edge_length);
  EXPECT_LE(least, 1.5 * edge_length);
}

TEST(LatticePoints, FillAWallAndNotTheCavityBehindIt) {
  Shape shape;
  add_sphere(shape, 3, 1, false, true);
  add_sphere(shape, 3, 0.7, true, false);
  put_on_grid(shape);
  for (lattice::Lattice kind : lattices) expect_inside(shape, shape.place({kind, 0.1 * shape.unit, 0}));
  EXPECT_TRUE(shape.place({lattice::Lattice::fcc, 0.3 * shape.unit, 0}).empty());
}

TEST(LatticePoints, GetFewerWithGreaterGrading) {
  const Shape shape = sphere(4);
  std::size_t last = shape.place({lattice::Lattice::fcc, 0, 0}).size();
  for (double grading : {0.1, 0.3, 1.0}) {
    const std::size_t now = shape.place({lattice::Lattice::fcc, 0, grading}).size();
    EXPECT_LT(now, last);
    EXPECT_GT(now, 0u);
    last = now;
  }
}

TEST(LatticePoints, FollowAnEvenSurfaceOfTheTargetSizeWithoutGrading) {
  const Shape shape = sphere(4);
  const double edge_length = 0.07 * shape.unit;
  EXPECT_EQ(shape.place({lattice::Lattice::fcc, edge_length, 0.5}),
            shape.place({lattice::Lattice::fcc, edge_length, 0}));
}

TEST(LatticePoints, AreRefusedBeforeTheyFillTheMemory) {
  const Shape shape = cube(2);
  EXPECT_THROW(shape.place({lattice::Lattice::fcc, 1e-4 * shape.unit, 0.5}), LimitError);
}

TEST(LatticePoints, AreNoneWithoutALatticeOrASurface) {
  EXPECT_TRUE(cube(6).place({lattice::Lattice::none, 0, 0.5}).empty());
  EXPECT_TRUE(Shape{}.place({lattice::Lattice::fcc, 1, 0.5}).empty());
}

TEST(CellSize, HasFewBitsAndIsNear) {
  for (double x = 1; x < 1e15; x *= 1.37) {
    const double rounded = lattice::round_to_few_bits(x);
    EXPECT_NEAR(rounded / x, 1, 0.004);
    int exponent = 0;
    const double bits = std::ldexp(std::frexp(rounded, &exponent), 8);
    EXPECT_EQ(bits, std::round(bits));
  }
}

TEST(SmallestBall, TouchesTheCornersOfAnAcuteTriangleAndTheLongestEdgeOfAnObtuseOne) {
  const Ball acute = smallest_ball(lattice::TrianglePoints{Point3{0, 0, 5}, {10, 0, 5}, {4, 8, 5}});
  for (const Point3& p : {Point3{0, 0, 5}, {10, 0, 5}, {4, 8, 5}})
    EXPECT_NEAR(std::sqrt(squared_length(p - acute.center)), acute.radius, 1e-7);
  const Ball obtuse = smallest_ball(lattice::TrianglePoints{Point3{4, 1, 0}, {0, 0, 0}, {10, 0, 0}});
  EXPECT_NEAR(obtuse.center.x, 5, 1e-12);
  EXPECT_NEAR(obtuse.center.y, 0, 1e-12);
  EXPECT_NEAR(obtuse.radius, 5, 1e-7);
}

}  // namespace
}  // namespace ccdt::test
