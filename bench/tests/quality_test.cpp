#include "bench/quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace ccdt {
namespace {

const std::array<Point3, 4> regular = {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
const std::array<Point3, 4> corner = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

TetMesh mesh_of(const std::array<Point3, 4>& tetrahedron) {
  TetMesh mesh;
  mesh.vertices.assign(tetrahedron.begin(), tetrahedron.end());
  mesh.tetrahedra = {{0, 1, 2, 3}};
  return mesh;
}

TEST(Quality, RegularTetrahedronHasMeasureOneAndItsDihedralAngle) {
  EXPECT_NEAR(shape_measure(regular), 1, 1e-14);
  for (const double angle : dihedral_angles(regular)) EXPECT_NEAR(angle, 70.528779365509308, 1e-12);
}

TEST(Quality, CornerOfACubeHasThePapersMeasure) {
  // Squared edges 1, 1, 1, 2, 2, 2 and volume 1/6: 1.5^1.5 * 6 / 8.48528.
  EXPECT_NEAR(shape_measure(corner), 1.299038, 1e-6);
  const auto angles = dihedral_angles(corner);
  EXPECT_NEAR(angles[0], 90, 1e-12);
  EXPECT_NEAR(angles[5], std::acos(1 / std::sqrt(3.0)) * 57.295779513082323, 1e-12);
}

TEST(Quality, FlatTetrahedronIsInfinitelyBad) {
  EXPECT_TRUE(std::isinf(shape_measure({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}})));
}

TEST(Quality, SizeAndPlaceDoNotMatter) {
  std::array<Point3, 4> moved = corner;
  for (Point3& p : moved) p = 1e-3 * p + Point3{5, 6, 7};
  EXPECT_NEAR(shape_measure(moved), shape_measure(corner), 1e-9);
}

TEST(Quality, HistogramsCountEveryTetrahedronAndEveryAngle) {
  TetMesh mesh = mesh_of(corner);
  for (const Point3& p : regular) mesh.vertices.push_back(p);
  mesh.tetrahedra.push_back({4, 5, 6, 7});
  const Quality quality = measure_quality(mesh);
  const auto sum = [](const Histogram& h) { return std::accumulate(h.counts.begin(), h.counts.end(), 0ull); };
  EXPECT_EQ(sum(quality.r.histogram), 2u);
  EXPECT_EQ(sum(quality.dihedral_degrees.histogram), 12u);
  EXPECT_EQ(quality.r.histogram.edges.size(), quality.r.histogram.counts.size() + 1);
  EXPECT_EQ(quality.dihedral_degrees.histogram.counts[14], 6u);  // 70 to 75 degrees: the regular one's
}

TEST(Quality, OfAMeshSummarizesItsTetrahedra) {
  const Quality quality = measure_quality(mesh_of(corner));
  EXPECT_EQ(quality.r.min, quality.r.max);
  EXPECT_NEAR(quality.r.mean, shape_measure(corner), 1e-15);
  EXPECT_NEAR(quality.dihedral_degrees.max, 90, 1e-12);
  EXPECT_NEAR(quality.volume, 1.0 / 6, 1e-15);
}

TEST(Quality, OfAnEmptyMeshIsZero) {
  const Quality quality = measure_quality({});
  EXPECT_EQ(quality.r.max, 0);
  EXPECT_EQ(quality.volume, 0);
}

}  // namespace
}  // namespace ccdt
