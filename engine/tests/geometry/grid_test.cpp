#include "engine/geometry/grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/geometry/grid.h"
#include "engine/tests/geometry/numbers_cases.h"

namespace ccdt {
namespace {

using namespace test;

double draw_real(Random& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Points in a box, its corners among them.
std::vector<Point3> draw_box_points(const Point3& low, const Point3& size, int n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point3> points = {low, low + size};
  for (int i = 2; i < n; ++i)
    points.push_back(
        {low.x + draw_real(random) * size.x, low.y + draw_real(random) * size.y, low.z + draw_real(random) * size.z});
  return points;
}

double largest_extent(const std::vector<Point3>& points) {
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(points.begin(), points.end(), [axis](const auto& p, const auto& q) {
      return as_array(p)[axis] < as_array(q)[axis];
    });
    extent = std::max(extent, as_array(*high)[axis] - as_array(*low)[axis]);
  }
  return extent;
}

struct NamedBox {
  const char* name;
  Point3 low, size;
};

const NamedBox boxes[] = {
    {"unit cube", {0, 0, 0}, {1, 1, 1}},
    {"just above a power of two", {-1, -1, -1}, {2.0000000000000004, 1, 0.5}},
    {"flat box", {3, -7, 11}, {1000, 1e-6, 0}},
    {"tiny", {1e-280, 1e-280, 1e-280}, {1e-280, 2e-280, 3e-280}},
    {"huge", {-1e300, -1e300, 0}, {2e300, 2e300, 1e300}},
    {"as large as doubles are", {-1.7e308, 0, 0}, {1.7e308, 1.7e308, 1}},
    {"small and far from the origin", {1e9, -1e9, 1e9}, {1e-3, 1e-3, 1e-3}},
    {"large and beside the origin", {1e6, 1e6, 1e6}, {3e6, 2e6, 1e6}},
};

TEST(Grid, MovesPointsByHalfAQuantumAtMost) {
  for (const NamedBox& box : boxes) {
    const auto points = draw_box_points(box.low, box.size, 3000, 1);
    const DyadicGrid grid = make_grid(points);
    for (const Point3& p : points) {
      const Point3 snapped = grid.snap(p);
      for (int axis = 0; axis < 3; ++axis) {
        // In grid units; the rounding of the input's own precision is added where the box is far from the origin.
        const double off = (as_array(p)[axis] - as_array(grid.origin)[axis]) / grid.unit - as_array(snapped)[axis];
        ASSERT_LE(std::fabs(off), DyadicGrid::quantum / 2) << box.name;
      }
    }
  }
}

TEST(Grid, TheQuantumIsBelowTheBoxByTwoToTheThirtyFirst) {
  for (const NamedBox& box : boxes) {
    const auto points = draw_box_points(box.low, box.size, 10, 1);
    const DyadicGrid grid = make_grid(points);
    const double extent = largest_extent(points);
    int exponent;
    EXPECT_EQ(std::frexp(grid.unit, &exponent), 0.5) << box.name << ": the unit is a power of two";
    EXPECT_LT(DyadicGrid::quantum * grid.unit, extent * 0x1p-31) << box.name;
    EXPECT_GE(DyadicGrid::quantum * grid.unit, extent * 0x1p-32) << box.name;
  }
}

TEST(Grid, CoordinatesAreMultiplesOfTheQuantumWhoseDifferencesAreExact) {
  for (const NamedBox& box : boxes) {
    const auto points = draw_box_points(box.low, box.size, 1000, 2);
    const DyadicGrid grid = make_grid(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point3 a = grid.snap(points[i]), b = grid.snap(points[i / 2]);
      for (int axis = 0; axis < 3; ++axis) {
        const double x = as_array(a)[axis], y = as_array(b)[axis];
        ASSERT_EQ(std::fmod(x, DyadicGrid::quantum), 0) << box.name;
        ASSERT_LE(std::fabs(x), static_cast<double>(largest_coordinate)) << box.name;
        ASSERT_EQ(static_cast<std::int64_t>(x - y), static_cast<std::int64_t>(x) - static_cast<std::int64_t>(y));
      }
    }
  }
}

TEST(Grid, SnappedPointsReturnFromTheWorldUnchanged) {
  for (const NamedBox& box : boxes) {
    // Far from the origin, doubles are coarser than the quantum, so original coordinates cannot be restored.
    if (std::fabs(box.low.x) > 1e5 * box.size.x) continue;
    const auto points = draw_box_points(box.low, box.size, 2000, 3);
    const DyadicGrid grid = make_grid(points);
    for (const Point3& p : points) {
      const Point3 snapped = grid.snap(p);
      ASSERT_EQ(grid.snap(grid.to_world(snapped)), snapped) << box.name;
    }
  }
}

TEST(Grid, ABoxThatDoublesCannotDivideIsAPoint) {
  const auto points = draw_box_points({1e-300, 1e-300, 1e-300}, {1e-300, 2e-300, 3e-300}, 100, 7);
  const DyadicGrid grid = make_grid(points);
  EXPECT_GT(grid.unit, std::numeric_limits<double>::min());
  for (const Point3& p : points) {
    EXPECT_EQ(grid.snap(p), grid.snap(points[0]));
    EXPECT_NEAR(grid.to_world(grid.snap(p)).z, p.z, grid.unit * DyadicGrid::quantum);
  }
}

/// Coordinates with 24 significant bits, none of them below the quantum.
TEST(Grid, FilesOfSinglePrecisionDoNotChange) {
  Random random(4);
  std::vector<Point3> points;
  const auto single = [&] { return static_cast<double>(static_cast<float>(1 + 99 * draw_real(random))); };
  for (int i = 0; i < 5000; ++i) points.push_back({single(), single(), single()});
  const DyadicGrid grid = make_grid(points);
  for (const Point3& p : points) ASSERT_EQ(grid.to_world(grid.snap(p)), p);
}

TEST(Grid, OneSideOfAPowerOfTwoIsAsGoodAsTheOther) {
  for (const double extent : {std::nextafter(8.0, 0), 8.0, std::nextafter(8.0, 9)}) {
    const std::vector<Point3> points = {{0, 0, 0}, {extent, 1, 2}};
    const DyadicGrid grid = make_grid(points);
    EXPECT_EQ(grid.unit, extent > 8 ? 0x1p-48 : 0x1p-49);
    for (const Point3& p : points) EXPECT_LE(std::fabs(grid.snap(p).x), static_cast<double>(largest_coordinate));
  }
}

TEST(Grid, OnePointAndNoPointHaveAGrid) {
  const std::vector<Point3> one = {{3.25, -1e9, 7e-200}};
  const DyadicGrid grid = make_grid(one);
  EXPECT_TRUE(std::isfinite(grid.unit) && grid.unit > 0);
  EXPECT_EQ(grid.to_world(grid.snap(one[0])).x, 3.25);
  EXPECT_EQ(grid.to_world(grid.snap(one[0])).y, -1e9);
  EXPECT_NEAR(grid.to_world(grid.snap(one[0])).z, 7e-200, grid.unit * DyadicGrid::quantum);
  EXPECT_EQ(make_grid({}).unit, grid.unit);
  EXPECT_EQ(make_grid({}).origin, Point3{});
  const std::vector<Point3> far = {{std::numeric_limits<double>::max(), -1e300, 1}};
  EXPECT_EQ(make_grid(far).snap(far[0]), Point3{});
  EXPECT_EQ(make_grid(far).origin.x, far[0].x);
  EXPECT_EQ(make_grid(far).origin.y, far[0].y);
}

TEST(Grid, EqualCoordinatesStayEqualAndOrderIsKept) {
  const auto points = draw_box_points({-5, 2, 0}, {3, 9, 4}, 2000, 6);
  const DyadicGrid grid = make_grid(points);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point3 &p = points[i - 1], &q = points[i];
    const Point3 a = grid.snap(p), b = grid.snap(q);
    if (p.x <= q.x) {
      ASSERT_LE(a.x, b.x);
    }
    ASSERT_EQ(grid.snap({p.x, q.y, q.z}).x, a.x);
  }
}

TEST(Grid, RoundsConstructedCoordinatesToTheUnit) {
  EXPECT_EQ(round_to_unit(2.25), 2);
  EXPECT_EQ(round_to_unit(-2.75), -3);
  EXPECT_EQ(round_to_unit(static_cast<double>(largest_coordinate)), static_cast<double>(largest_coordinate));
}

}  // namespace
}  // namespace ccdt
