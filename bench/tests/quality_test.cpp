#include "bench/run/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "bench/run/surface_limit.h"
#include "engine/geometry/tetrahedron_shape.h"

namespace ccdt {
namespace {

const std::array<Point3, 4> regular = {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
const std::array<Point3, 4> corner = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

mesh::TetMesh mesh_of(const std::array<Point3, 4>& tetrahedron) {
  mesh::TetMesh mesh;
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

/// A tetrahedron with all its faces, which are triangles of the surface.
mesh::TetMesh mesh_with_faces(const std::array<Point3, 4>& tetrahedron) {
  mesh::TetMesh mesh = mesh_of(tetrahedron);
  mesh.faces = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  return mesh;
}

TEST(SurfaceLimit, AGoodTetrahedronIsNotLimited) {
  EXPECT_FALSE(bench::find_surface_limit(mesh_with_faces(regular)).limits_quality());
}

TEST(SurfaceLimit, ANeedleOnTheSurfaceLimits) {
  const auto limit = bench::find_surface_limit(mesh_with_faces({{{0, 0, 0}, {10, 0, 0}, {0, 1, 0}, {0, 0, 1}}}));
  EXPECT_TRUE(limit.limits_quality());
  EXPECT_EQ(limit.bad_tetrahedra, 1u);
  EXPECT_EQ(limit.at_bad_triangles, 1u);
  EXPECT_NEAR(limit.least_angle, 5.711, 0.001);  // the arc tangent of a tenth
}

TEST(SurfaceLimit, ABadTetrahedronAmongGoodTrianglesIsNotTheSurfacesFault) {
  const auto limit = bench::find_surface_limit(mesh_with_faces({{{0, 0, 0}, {1, 0, 0.01}, {1, 1, 0}, {0, 1, 0.01}}}));
  EXPECT_EQ(limit.bad_tetrahedra, 1u);
  EXPECT_FALSE(limit.limits_quality());
}

/// All edges have different lengths: 2, 3, 4 from the corner, then the roots of 13, 20 and 25.
const std::array<Point3, 4> uneven = {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}}};

TEST(Quality, EachEdgeCountsOnce) {
  // Squared edges 4, 9, 16, 13, 20, 25, volume 4.
  EXPECT_NEAR(shape_measure(uneven), std::pow(87 / 6.0, 1.5) / (6 * std::sqrt(2.0) * 4), 1e-13);
  // The circumscribed sphere is that of the box.
  EXPECT_NEAR(radius_edge_ratio(uneven), std::sqrt(29.0) / 2 / 2, 1e-13);
  std::array<Point3, 4> corners = uneven;
  std::ranges::sort(corners, {}, [](const Point3& p) { return std::array{p.x, p.y, p.z}; });
  do {
    EXPECT_NEAR(shape_measure(corners), shape_measure(uneven), 1e-13);
    EXPECT_NEAR(radius_edge_ratio(corners), radius_edge_ratio(uneven), 1e-13);
    EXPECT_NEAR(aspect_ratio(corners), aspect_ratio(uneven), 1e-13);
  } while (std::ranges::next_permutation(corners, {}, [](const Point3& p) { return std::array{p.x, p.y, p.z}; }).found);
}

TEST(Quality, FlatTetrahedronIsInfinitelyBad) {
  const std::array<Point3, 4> flat = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  for (const auto measure : {shape_measure, aspect_ratio, radius_edge_ratio}) EXPECT_TRUE(std::isinf(measure(flat)));
}

TEST(Quality, AspectRatioIsThatOfVtk) {
  EXPECT_NEAR(aspect_ratio(regular), 1, 1e-14);
  // Longest edge sqrt(2); the inscribed sphere's radius is 3 V / area = 1 / (3 + sqrt(3)).
  EXPECT_NEAR(aspect_ratio(corner), std::sqrt(2.0) * (3 + std::sqrt(3.0)) / (2 * std::sqrt(6.0)), 1e-14);
}

TEST(Quality, RadiusEdgeRatioIsThatOfTetGen) {
  EXPECT_NEAR(radius_edge_ratio(regular), std::sqrt(6.0) / 4, 1e-14);
  EXPECT_NEAR(radius_edge_ratio(corner), std::sqrt(3.0) / 2, 1e-14);  // of the cube around it
}

TEST(Quality, RadiusEdgeRatioDoesNotSeeASliverButTheOthersDo) {
  const std::array<Point3, 4> sliver = {{{1, 0, 1e-3}, {-1, 0, 1e-3}, {0, 1, -1e-3}, {0, -1, -1e-3}}};
  EXPECT_LT(radius_edge_ratio(sliver), 0.8);
  EXPECT_GT(aspect_ratio(sliver), 100);
  EXPECT_GT(shape_measure(sliver), 100);
}

TEST(Quality, SizeAndPlaceDoNotMatter) {
  std::array<Point3, 4> moved = corner;
  for (Point3& p : moved) p = 1e-3 * p + Point3{5, 6, 7};
  for (const auto measure : {shape_measure, aspect_ratio, radius_edge_ratio})
    EXPECT_NEAR(measure(moved), measure(corner), 1e-9);
}

TEST(Quality, HistogramsCountEveryTetrahedronAndEveryAngle) {
  mesh::TetMesh mesh = mesh_of(corner);
  for (const Point3& p : regular) mesh.vertices.push_back(p);
  mesh.tetrahedra.push_back({4, 5, 6, 7});
  const bench::Quality quality = bench::measure_quality(mesh);
  const auto sum = [](const bench::Histogram& h) { return std::accumulate(h.counts.begin(), h.counts.end(), 0ull); };
  for (const bench::Quality::Measure& measure : {quality.r, quality.aspect_ratio, quality.radius_edge_ratio})
    EXPECT_EQ(sum(measure.histogram), 2u);
  EXPECT_EQ(sum(quality.dihedral_degrees.histogram), 12u);
  EXPECT_EQ(quality.r.histogram.edges.size(), quality.r.histogram.counts.size() + 1);
  EXPECT_EQ(quality.dihedral_degrees.histogram.counts[14], 6u);  // 70 to 75 degrees: the regular one's
  EXPECT_EQ(quality.dihedral_degrees.histogram.counts[18], 3u);  // 90 to 95 degrees: the corner's right angles
}

TEST(Quality, AnglesAreCountedInTheBinsOfTheirDegrees) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  mesh::TetMesh mesh;
  std::vector<std::uint64_t> counts(36, 0);
  double least = 180, most = 0;
  for (std::uint32_t i = 0; i < 4000; i += 4) {
    std::array<Point3, 4> corners;
    // Every other one is nearly flat, so that the sharpest and the widest bins are used too.
    for (Point3& p : corners)
      p = {coordinate(random), coordinate(random), coordinate(random) * (i % 8 == 0 ? 1 : 0.05)};
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    mesh.tetrahedra.push_back({i, i + 1, i + 2, i + 3});
    for (const double angle : dihedral_angles(corners)) {
      ++counts[static_cast<std::size_t>(angle / 5)];
      least = std::min(least, angle), most = std::max(most, angle);
    }
  }
  const bench::Quality::Dihedral dihedral = bench::measure_quality(mesh).dihedral_degrees;
  EXPECT_EQ(dihedral.histogram.counts, counts);
  EXPECT_TRUE(std::ranges::all_of(counts, [](std::uint64_t count) { return count > 0; }));
  EXPECT_EQ(dihedral.min, least);
  EXPECT_EQ(dihedral.max, most);
}

TEST(Quality, OfAMeshSummarizesItsTetrahedra) {
  const bench::Quality quality = bench::measure_quality(mesh_of(corner));
  EXPECT_EQ(quality.r.min, quality.r.max);
  EXPECT_NEAR(quality.r.mean, shape_measure(corner), 1e-15);
  EXPECT_EQ(quality.aspect_ratio.max, aspect_ratio(corner));
  EXPECT_EQ(quality.radius_edge_ratio.median, radius_edge_ratio(corner));
  EXPECT_NEAR(quality.dihedral_degrees.max, 90, 1e-12);
  EXPECT_NEAR(quality.volume, 1.0 / 6, 1e-15);
}

/// Corners of more and more uneven boxes, and one beyond the first 8,192 of another shape.
mesh::TetMesh long_mesh() {
  mesh::TetMesh mesh;
  for (std::uint32_t i = 0; i < 10001; ++i) {
    const double size = i == 9000 ? 1e-3 : 1 + i * 1e-3;
    const std::array<Point3, 4> corners = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {i == 9000 ? -3.0 : 0.0, 0, size}}};
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    mesh.tetrahedra.push_back({4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3});
  }
  return mesh;
}

TEST(Quality, QuantilesAreThoseOfTheSortedValues) {
  const mesh::TetMesh mesh = long_mesh();
  std::vector<double> r;
  double widest = 0;
  for (const auto& t : mesh.tetrahedra) {
    const std::array corners = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]};
    r.push_back(shape_measure(corners));
    widest = std::max(widest, std::ranges::max(dihedral_angles(corners)));
  }
  std::ranges::sort(r);
  const bench::Quality quality = bench::measure_quality(mesh);
  EXPECT_DOUBLE_EQ(quality.r.min, r.front());
  EXPECT_DOUBLE_EQ(quality.r.median, r[5000]);
  EXPECT_DOUBLE_EQ(quality.r.p99, r[9900]);
  EXPECT_DOUBLE_EQ(quality.r.max, r.back());
  EXPECT_DOUBLE_EQ(quality.dihedral_degrees.max, widest);
}

TEST(Quality, CountsOfALongMeshAreThoseOfAllItsParts) {
  const mesh::TetMesh mesh = long_mesh();
  const bench::Quality quality = bench::measure_quality(mesh);
  const auto sum = [](const bench::Histogram& h) { return std::accumulate(h.counts.begin(), h.counts.end(), 0ull); };
  EXPECT_EQ(sum(quality.dihedral_degrees.histogram), 6 * mesh.tetrahedra.size());
  EXPECT_EQ(sum(quality.r.histogram), mesh.tetrahedra.size());
}

TEST(Quality, TheLastBinsAreForTheWorstTetrahedra) {
  for (const auto& [height, from_the_end] : {std::pair{0.01, 1u}, {0.005, 0u}, {1e-4, 0u}}) {  // r is 0.707 / height
    const bench::Histogram r =
        bench::measure_quality(mesh_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, height}}})).r.histogram;
    EXPECT_EQ(r.counts[r.counts.size() - 1 - from_the_end], 1u) << height;
  }
}

TEST(Quality, AnInvertedTetrahedronHasANegativeVolume) {
  mesh::TetMesh mesh = mesh_of(uneven);
  EXPECT_NEAR(bench::measure_quality(mesh).volume, 4, 1e-14);
  mesh.tetrahedra.push_back({0, 2, 1, 3});
  EXPECT_NEAR(bench::measure_quality(mesh).volume, 0, 1e-14);
}

TEST(Quality, OfAnEmptyMeshIsZero) {
  const bench::Quality quality = bench::measure_quality({});
  EXPECT_EQ(quality.r.max, 0);
  EXPECT_EQ(quality.volume, 0);
}

}  // namespace
}  // namespace ccdt
