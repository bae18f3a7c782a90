#include <gtest/gtest.h>

#include "engine/geometry/predicates.h"
#include "engine/tests/geometry/numbers_cases.h"
#include "engine/tests/geometry/numbers_reference.h"

// Coordinates as large as their number of bits allows, for each number of bits: where an integer type would be too
// narrow, determinants of these are the first to overflow.

namespace ccdt {
namespace {

using namespace test;

constexpr int most_bits = 51;

/// A corner of the cube of this half-size around the origin. Some coordinates are nearer to zero by one.
Point3 draw_near_corner(Random& random, double half) {
  const auto one = [&] { return (random() % 2 == 0 ? 1 : -1) * (half - static_cast<double>(random() % 4 == 0)); };
  return {one(), one(), one()};
}

/// Calls one(points, bits) with the origin and corners of cubes, so that differences from the origin have `bits` bits.
template <class Case>
void for_all_widths(const Case& one) {
  Random random(31);
  for (int bits = 1; bits <= most_bits; ++bits)
    for (int i = 0; i < cases(2000); ++i) {
      std::array<Point3, 5> p = {};
      for (std::size_t k = 1; k < 5; ++k)
        p[k] = draw_near_corner(random, static_cast<double>((std::int64_t{1} << bits) - 1));
      one(p, bits);
    }
}

TEST(Predicates, OrientationIsRightForTheLargestNumbersOfEachWidth) {
  for_all_widths([](const auto& p, int bits) {
    const int right = reference::orient3d(p[0], p[1], p[2], p[3]);
    ASSERT_EQ(orient3d_exactly(p[0], p[1], p[2], p[3]), right) << bits << " bits";
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), right) << bits << " bits";
  });
}

TEST(Predicates, InsphereIsRightForTheLargestNumbersOfEachWidth) {
  for_all_widths([](const auto& p, int bits) {
    const int right = reference::insphere(p[1], p[2], p[3], p[4], p[0]);
    ASSERT_EQ(insphere_exactly(p[1], p[2], p[3], p[4], p[0]), right) << bits << " bits";
    ASSERT_EQ(insphere(p[1], p[2], p[3], p[4], p[0]), right) << bits << " bits";
  });
}

/// A determinant of 1 or -1 of large numbers: in the integers, the upper digits cancel.
TEST(Predicates, VolumesOfOneAreNotZeroAtAnyWidth) {
  for (int bits = 1; bits <= most_bits; ++bits) {
    const double n = static_cast<double>((std::int64_t{1} << bits) - 1);
    // The rows (n, n-1, 0), (1, 1, 0) have the minor 1.
    const Point3 a{0, 0, 0}, b{n, n - 1, n}, c{1, 1, n}, d{0, 0, 1};
    EXPECT_EQ(orient3d_exactly(a, b, c, d), 1) << bits << " bits";
    EXPECT_EQ(orient3d_exactly(a, c, b, d), -1) << bits << " bits";
    EXPECT_EQ(orient3d(a, b, c, d), 1) << bits << " bits";
    EXPECT_EQ(orient3d_exactly(a, b, c, {n + 1, n, 2 * n}), 0) << bits << " bits";
  }
}

}  // namespace
}  // namespace ccdt
