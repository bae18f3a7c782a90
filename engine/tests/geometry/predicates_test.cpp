#include "engine/geometry/predicates.h"

#include <gtest/gtest.h>

#include "engine/geometry/predicates.h"
#include "engine/tests/geometry/numbers_cases.h"
#include "engine/tests/geometry/numbers_reference.h"

namespace ccdt {
namespace {

using namespace test;

/// Compares a sign with its reference on points of every family.
template <class Tested, class Reference>
void expect_equal_signs(int cases_per_family, const Tested& tested, const Reference& reference) {
  Random random(20051);
  for (const Family family : all_families) {
    int disagreements = 0;
    for (int i = 0; i < cases_per_family; ++i) {
      const auto p = draw_points(random, family);
      if (tested(p) != reference(p)) ++disagreements;
    }
    EXPECT_EQ(disagreements, 0) << "of " << cases_per_family << " of family " << static_cast<int>(family);
  }
}

TEST(Predicates, OrientationIsPositiveAboveACounterclockwiseTriangle) {
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, -1}), -1);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 0}), 0);
}

TEST(Predicates, InsphereIsPositiveInsideAPositiveTetrahedron) {
  const Point3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0}, d{0, 0, 4};
  EXPECT_EQ(insphere(a, b, c, d, {1, 1, 1}), 1);
  EXPECT_EQ(insphere(a, b, c, d, {5, 5, 5}), -1);
  EXPECT_EQ(insphere(a, b, c, d, {4, 4, 4}), 0);
  EXPECT_EQ(insphere(b, a, c, d, {1, 1, 1}), -1);
}

TEST(Predicates, OrientationAgreesWithTheExactKernel) {
  expect_equal_signs(
      cases(440000), [](const auto& p) { return orient3d(p[0], p[1], p[2], p[3]); },
      [](const auto& p) { return reference::orient3d(p[0], p[1], p[2], p[3]); });
}

TEST(Predicates, InsphereAgreesWithTheExactKernel) {
  expect_equal_signs(
      cases(440000), [](const auto& p) { return insphere(p[0], p[1], p[2], p[3], p[4]); },
      [](const auto& p) { return reference::insphere(p[0], p[1], p[2], p[3], p[4]); });
}

TEST(Predicates, CollinearityAgreesWithTheExactKernel) {
  expect_equal_signs(
      cases(150000), [](const auto& p) { return collinear(p[0], p[1], p[2]); },
      [](const auto& p) { return reference::collinear(p[0], p[1], p[2]); });
}

TEST(Predicates, TheFamiliesHoldZerosAndSignsOfBothKinds) {
  Random random(7);
  for (const Family family : all_families) {
    std::array<int, 3> volumes = {}, spheres = {};
    for (int i = 0; i < 5000; ++i) {
      const auto p = draw_points(random, family);
      ++volumes[orient3d(p[0], p[1], p[2], p[3]) + 1];
      ++spheres[insphere(p[0], p[1], p[2], p[3], p[4]) + 1];
    }
    const bool degenerate = family != Family::anywhere && family != Family::box_of_any_size;
    for (const auto& counts : {volumes, spheres}) {
      EXPECT_GT(counts[0], 50) << static_cast<int>(family);
      EXPECT_GT(counts[2], 50) << static_cast<int>(family);
      if (degenerate) {
        EXPECT_GT(counts[1], 10) << static_cast<int>(family);
      }
    }
  }
}

/// The determinants do not change their signs when all coordinates are scaled by a power of two, whichever stage of
/// the evaluation they then come to.
TEST(Predicates, SignsDoNotDependOnTheScale) {
  Random random(11);
  for (int i = 0; i < cases(20000); ++i) {
    std::array<Point3, 5> p;
    for (Point3& q : p)
      q = {double(draw_between(random, -700, 700)), double(draw_between(random, -700, 700)),
           double(draw_between(random, -700, 700))};
    const int volume = orient3d(p[0], p[1], p[2], p[3]), sphere = insphere(p[0], p[1], p[2], p[3], p[4]);
    for (const double scale : {0x1p8, 0x1p17, 0x1p31, 0x1p41}) {
      const auto s = [&](int k) { return scale * p[k]; };
      ASSERT_EQ(orient3d(s(0), s(1), s(2), s(3)), volume);
      ASSERT_EQ(insphere(s(0), s(1), s(2), s(3), s(4)), sphere);
    }
  }
}

}  // namespace
}  // namespace ccdt
