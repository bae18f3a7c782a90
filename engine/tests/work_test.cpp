#include <gtest/gtest.h>

#include "engine/base/count_work.h"
#include "engine/delaunay/delaunay.h"

namespace ccdt {
namespace {

std::vector<Point3> random_points(std::size_t n) {
  std::vector<Point3> points;
  std::uint64_t state = 1;
  const auto random = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 33);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const double x = random(), y = random(), z = random();
    points.push_back({x, y, z});
  }
  return points;
}

TEST(Work, CellsThatWereMadeAndNotDestroyedAreThere) {
  Work work;
  delaunay::Delaunay d;
  {
    const WorkScope scope(work);
    d = delaunay::build_delaunay(random_points(3000));
  }
  EXPECT_EQ(work.cells_created - work.cells_destroyed, d.cells.size() - d.free_cells.size());
  EXPECT_EQ(work.insertions, 2996);
}

TEST(Work, OfAScopeIsTheSameInsideOthersAndIsTheirsToo) {
  Work alone, inner, outer;
  {
    const WorkScope scope(alone);
    delaunay::build_delaunay(random_points(500));
  }
  {
    const WorkScope around(outer);
    delaunay::build_delaunay(random_points(100));
    const WorkScope scope(inner);
    delaunay::build_delaunay(random_points(500));
  }
  EXPECT_EQ(inner, alone);
  EXPECT_EQ(outer.insertions, 96u + 496u);
  EXPECT_GE(outer.largest_cavity, inner.largest_cavity);
}

}  // namespace
}  // namespace ccdt
