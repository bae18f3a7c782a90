#include "engine/geometry/filters.h"

#include <gtest/gtest.h>

#include <array>

#include "engine/geometry/filters.h"
#include "engine/geometry/predicates.h"
#include "engine/tests/geometry/numbers_cases.h"

namespace ccdt {
namespace {

using namespace test;

/// The corners of the face opposite to each corner of a tetrahedron, counterclockwise seen from outside.
constexpr std::array<std::array<std::size_t, 3>, 4> faces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

FacesAround faces_around(const std::array<Point3, 4>& t, const Point3& e) {
  Lanes a, b, c, d, p;
  using filter::load;
  load(t[0], a), load(t[1], b), load(t[2], c), load(t[3], d), load(e, p);
  return faces_around_filter(a, b, c, d, p);
}

SpheresAround spheres_around(const std::array<Point3, 4>& t, const std::array<Point3, 4>& apex, const Point3& e,
                             unsigned wanted) {
  Lanes a, b, c, d, oa, ob, oc, od, p;
  using filter::load;
  load(t[0], a), load(t[1], b), load(t[2], c), load(t[3], d), load(e, p);
  load(apex[0], oa), load(apex[1], ob), load(apex[2], oc), load(apex[3], od);
  return spheres_around_filter(a, b, c, d, oa, ob, oc, od, p, wanted);
}

/// How many faces or spheres were decided.
struct Tally {
  int decided = 0, unknown = 0, wrong = 0;
};

/// All signs that the filter gives for one tetrahedron are right, and it gives none that was not asked for.
void check_spheres(const std::array<Point3, 4>& t, const std::array<Point3, 4>& apex, const Point3& e, unsigned wanted,
                   Tally& tally) {
  const auto [inside, on, unknown] = spheres_around(t, apex, e, wanted);
  tally.wrong += ((inside | on | unknown) & ~wanted) != 0 || (inside & on) != 0 || ((inside | on) & unknown) != 0;
  for (unsigned f = 0; f < 4; ++f) {
    if ((wanted >> f & 1) == 0) continue;
    if ((unknown >> f & 1) != 0) {
      ++tally.unknown;
      continue;
    }
    ++tally.decided;
    const auto& [i, j, k] = faces[f];
    const int sign = insphere(t[i], t[j], t[k], apex[f], e);
    tally.wrong += sign != ((inside >> f & 1) != 0 ? 1 : (on >> f & 1) != 0 ? 0 : -1);
  }
}

TEST(Filters, FacesAroundATetrahedron) {
  const std::array<Point3, 4> t = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}};
  EXPECT_EQ(faces_around(t, {1, 1, 1}).beyond, 0U);
  EXPECT_EQ(faces_around(t, {1, 1, 1}).unknown, 0U);
  EXPECT_EQ(faces_around(t, {2, 2, 2}).beyond, 1U);
  EXPECT_EQ(faces_around(t, {-1, 1, 1}).beyond, 2U);
  EXPECT_EQ(faces_around(t, {1, -1, -1}).beyond, 12U);
  EXPECT_EQ(faces_around(t, {1, 1, 0}).unknown, 8U);
}

TEST(Filters, SpheresAroundATetrahedron) {
  const std::array<Point3, 4> t = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}};
  const std::array<Point3, 4> apex = {{{4, 4, 4}, {-1, 1, 1}, {1, -9, 1}, {4, 4, -4}}};
  const auto [inside, on, unknown] = spheres_around(t, apex, {0, 4, 4}, 15);
  EXPECT_EQ(unknown, 0U);
  EXPECT_EQ(on & 1, 1U);  // the sphere of all corners of the cube
  EXPECT_EQ(inside & 8, 0U);
  EXPECT_EQ(spheres_around(t, apex, {0, 4, 4}, 2).on & 1, 0U);  // not asked for
}

TEST(Filters, FacesAroundAreRightWhereverTheyAreCertain) {
  Random random(20061);
  for (const Family family : all_families) {
    Tally tally;
    for (int i = 0; i < cases(100000); ++i) {
      const auto p = draw_points(random, family);
      const std::array t = {p[0], p[1], p[2], p[3]};
      const auto [beyond, unknown] = faces_around(t, p[4]);
      tally.wrong += (beyond & unknown) != 0;
      for (unsigned f = 0; f < 4; ++f) {
        if ((unknown >> f & 1) != 0) {
          ++tally.unknown;
          continue;
        }
        ++tally.decided;
        const auto& [i0, i1, i2] = faces[f];
        const int outward = orient3d(t[i0], t[i1], t[i2], p[4]);
        tally.wrong += outward != ((beyond >> f & 1) != 0 ? 1 : -1);
      }
    }
    EXPECT_EQ(tally.wrong, 0) << "of " << tally.decided << " of family " << static_cast<int>(family);
    EXPECT_GT(tally.decided, 0);
    EXPECT_TRUE(family != Family::plane || tally.unknown > 0);
  }
}

TEST(Filters, SpheresAroundAreRightWhereverTheyAreDecided) {
  Random random(20062);
  for (const Family family : all_families) {
    Tally tally;
    for (int i = 0; i < cases(100000); ++i) {
      const auto p = draw_points(random, family), q = draw_points(random, family);
      // Any corners will do, those of the tetrahedron and of other scales among them.
      std::array<Point3, 4> apex;
      for (Point3& point : apex) point = random() % 4 == 0 ? q[random() % 6] : p[random() % 6];
      check_spheres({p[0], p[1], p[2], p[3]}, apex, p[4], random() % 16, tally);
    }
    EXPECT_EQ(tally.wrong, 0) << "of " << tally.decided << " of family " << static_cast<int>(family);
    EXPECT_GT(tally.decided, 0);
  }
}

TEST(Filters, SpheresAroundDecideAllInALattice) {
  Random random(20063);
  Tally tally;
  for (int i = 0; i < cases(100000); ++i) {
    std::array<Point3, 9> p;
    for (Point3& point : p)
      point = 0x1p30 * Point3{static_cast<double>(random() % 5), static_cast<double>(random() % 5),
                              static_cast<double>(random() % 5)};
    check_spheres({p[0], p[1], p[2], p[3]}, {p[4], p[5], p[6], p[7]}, p[8], 15, tally);
  }
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_EQ(tally.unknown, 0);
}

}  // namespace
}  // namespace ccdt
