#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/base/errors.h"
#include "engine/base/portable_math.h"
#include "engine/base/union_find.h"
#include "engine/geometry/predicates.h"
#include "engine/refine/close_segments.h"
#include "engine/refine/refine_plc.h"
#include "engine/refine/segment_fans.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tests/shared/sanitized.h"
#include "models/solids.h"

namespace ccdt::refine {
namespace {

using namespace mesh_test;

struct Refined {
  plc::Plc before;
  RefinedPlc after;
};

/// \param edge_length  in the units of the input
Refined refined(const InputPlc& input, double edge_length, RefineOptions options = {}) {
  Refined r;
  r.before = plc::build_plc(input);
  options.edge_length = edge_length / r.before.grid.unit;
  r.after = refine_plc(r.before, options);
  return r;
}

std::vector<Point3> all_points(const RefinedPlc& refined) {
  std::vector<Point3> points = refined.plc.vertices;
  points.insert(points.end(), refined.on_segments.begin(), refined.on_segments.end());
  return points;
}

std::array<Point3, 3> corners(const std::array<VertexId, 3>& t, const std::vector<Point3>& points) {
  return {points[t[0]], points[t[1]], points[t[2]]};
}

double area_of(std::span<const std::array<VertexId, 3>> triangles, const std::vector<Point3>& points) {
  double area = 0;
  for (const auto& t : triangles) area += length(area_vector(corners(t, points))) / 2;
  return area;
}

void expect_exactly_in_place(const Refined& r) {
  const plc::Plc &before = r.before, &after = r.after.plc;
  const std::vector<Point3> points = all_points(r.after);
  ASSERT_EQ(after.facets.size(), before.facets.size());
  ASSERT_EQ(r.after.chains.size(), before.segments.size());
  for (std::size_t f = 0; f < before.facets.size(); ++f) {
    const auto triangles = after.triangles_of(after.facets[f]),
               triangles_before = before.triangles_of(before.facets[f]);
    EXPECT_NEAR(area_of(triangles, points) / area_of(triangles_before, points), 1, 1e-12);
    if (!before.facets[f].exactly_flat) continue;
    const auto plane = corners(triangles_before[0], points);
    for (const auto& t : triangles)
      for (const VertexId v : t) EXPECT_EQ(orient3d(plane[0], plane[1], plane[2], points[v]), 0);
  }
  for (std::size_t s = 0; s < before.segments.size(); ++s) {
    const auto chain = r.after.chains[s];
    EXPECT_EQ(chain.front().vertex, before.segments[s].ends[0]);
    EXPECT_EQ(chain.back().vertex, before.segments[s].ends[1]);
    for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
      EXPECT_LT(chain[i - 1].fraction, chain[i].fraction);
      EXPECT_GE(chain[i].vertex, after.vertices.size());
      EXPECT_TRUE(collinear(points[chain.front().vertex], points[chain[i].vertex], points[chain.back().vertex]));
    }
  }
}

double longest_piece(const RefinedPlc& refined) {
  const std::vector<Point3> points = all_points(refined);
  double longest = 0;
  for (std::size_t s = 0; s < refined.chains.size(); ++s) {
    const auto chain = refined.chains[s];
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      longest = std::max(longest, length(points[chain[i + 1].vertex] - points[chain[i].vertex]));
  }
  return longest * refined.plc.grid.unit;
}

/// A prism over a triangle with a small angle.
InputPlc wedge(double width) {
  return plc_test::prism({{0, 0}, {10, 0}, {10, width}});
}

/// A prism over a square whose corners are cut off, so that narrow strips run along its height.
InputPlc beveled_square(double bevel) {
  const double near = bevel, far = 4 - bevel;
  return plc_test::prism({{near, 0}, {far, 0}, {4, near}, {4, far}, {far, 4}, {near, 4}, {0, far}, {0, near}});
}

/// In degrees, of the faces of a mesh.
double least_angle_of_faces(const TetMesh& mesh) {
  double least = 180;
  for (const auto& f : mesh.faces)
    for (int i = 0; i < 3; ++i)
      least =
          std::min(least, angle_at(mesh.vertices[f[i]], mesh.vertices[f[(i + 1) % 3]], mesh.vertices[f[(i + 2) % 3]]) *
                              180 / portable::pi);
  return least;
}

MeshOptions refining(double edge_length) {
  MeshOptions options;
  options.surface = SurfaceRule::refine;
  options.edge_length = edge_length;
  options.improve.steiner = SteinerRule::keep;
  return options;
}

TEST(Refine, NewVerticesAreExactlyOnFacetsAndSegments) {
  for (const auto& [name, plc] : small_inputs()) {
    SCOPED_TRACE(name);
    expect_exactly_in_place(refined(plc, 0.4));
    expect_exactly_in_place(refined(rotated(oblique, plc), 0.4));
  }
}

TEST(Refine, ACubeGetsEvenTriangles) {
  MeshOptions options = refining(0.2);
  options.lattice = Lattice::none;
  const MeshResult r = mesh_plc(unit_cube(), options);
  EXPECT_GT(r.counts.refined_in_facets, 60u);
  EXPECT_EQ(r.counts.refined_on_segments, 48u);
  EXPECT_GE(least_angle_of_faces(r.mesh), 29);
}

TEST(Refine, TheUnitOfLengthMayBeTiny) {
  InputPlc tiny = unit_cube();
  for (Point3& p : tiny.vertices) p = 0x1p-330 * p;
  MeshOptions options = refining(0);
  options.lattice = Lattice::none;
  EXPECT_EQ(mesh_plc(tiny, options).mesh.tetrahedra, mesh_plc(unit_cube(), options).mesh.tetrahedra);
  EXPECT_THROW(mesh_plc(tiny, refining(1e-300)), LimitError);
}

TEST(Refine, VerticesThatSplitSegmentsAreNotSteinerVertices) {
  EXPECT_EQ(mesh_plc(unit_cube(), refining(0.2)).counts.steiner_vertices, 0u);
}

TEST(Refine, EdgesOfAThinPlateFitItsThickness) {
  EXPECT_LE(longest_piece(refined(box({0, 0, 0}, {2, 2, 0.1}), 0.5).after), 0.2);
}

TEST(Refine, NarrowStripsGetEdgesThatFit) {
  MeshOptions options = refining(0.5);
  options.lattice = Lattice::none;
  EXPECT_GE(least_angle_of_faces(mesh_plc(beveled_square(0.01), options).mesh), 20);
}

TEST(Refine, TheNarrowestStripsDoNotCostMillionsOfTetrahedra) {
  const double most = is_sanitized ? 1e5 : 1e6;
  const Refined r = refined(beveled_square(0.00002), 0.5, {.most_tetrahedra = most});
  expect_exactly_in_place(r);
  const auto points = static_cast<double>(all_points(r.after).size());
  EXPECT_GT(points, 0.001 * most);
  EXPECT_LT(points, 0.06 * most);
}

/// A cone over a circle of this many edges.
InputPlc cone(std::uint32_t edges) {
  InputPlc plc;
  plc.vertices = {{0, 0, 1}};
  plc.polygon_facets.emplace_back().polygons.emplace_back();
  for (std::uint32_t i = 0; i < edges; ++i) {
    const double angle = to_radians(360.0 * i / edges);
    plc.vertices.push_back({portable::cosine(angle), portable::cosine(angle - to_radians(90)), 0});
    plc.polygon_facets[0].polygons[0].push_back(i + 1);
    plc.triangles.push_back({0, i + 1, (i + 1) % edges + 1});
  }
  return plc;
}

TEST(Refine, ManyShortSegmentsDoNotCostMoreThanIsAllowed) {
  const std::size_t without_limit = all_points(refined(cone(400), 0.5).after).size();
  const Refined r = refined(cone(400), 0.5, {.most_tetrahedra = 2e4});
  expect_exactly_in_place(r);
  EXPECT_LT(3 * all_points(r.after).size(), 2 * without_limit);
}

TEST(Refine, TheThicknessOfAFlatPlateIsMeasuredOnce) {
  std::vector<std::array<double, 2>> circle;
  for (int i = 0; i < 60; ++i)
    circle.push_back({10 * portable::cosine(to_radians(6.0 * i)), 10 * portable::cosine(to_radians(6.0 * i - 90))});
  const std::uint64_t nodes = work_done.box_tree_nodes;
  const Refined r = refined(plc_test::prism(circle), 2);
  EXPECT_LT(work_done.box_tree_nodes - nodes, 1000 * all_points(r.after).size());
}

TEST(Refine, ExtremelyThinWallsDoNotTakeForever) {
  const std::uint64_t nodes = work_done.box_tree_nodes;
  refined(box({0, 0, 0}, {4, 4, 1e-5}), 0.2);
  EXPECT_LT(work_done.box_tree_nodes - nodes, 60'000'000u);
}

TEST(Refine, ThinPlacesCostInProportionToTheRest) {
  const InputPlc plate = box({0, 0, 0}, {10, 10, 1e-4});
  const std::size_t few = refined(plate, 2).after.plc.triangles.size(),
                    many = refined(plate, 0.25).after.plc.triangles.size();
  EXPECT_GT(few, 1000u);
  EXPECT_LT(few, 20000u);
  EXPECT_GT(many, 10000u);
  EXPECT_LT(many, 60000u);
}

TEST(Refine, LongSegmentsSideBySideCostFewFlips) {
  const std::uint64_t before = work_done.edges_flipped;
  const Refined r = refined(plc_test::box({0, 0, 0}, {50, 0.25, 0.25}), 0.25);
  EXPECT_GE(r.after.on_segments.size(), 700);
  EXPECT_LE(work_done.edges_flipped - before, 10 * r.after.on_segments.size());  // in the order along them: 50
}

TEST(Refine, VerticesInsideFacetsGetEdgesThatFit) {
  InputPlc plc = unit_cube();
  plc.vertices.push_back({0.5, 0.02, 0});  // near an edge
  std::erase(plc.triangles, std::array<std::uint32_t, 3>{0, 2, 3});
  std::erase(plc.triangles, std::array<std::uint32_t, 3>{0, 3, 1});
  for (const auto& [a, b] : {std::array{0u, 2u}, {2u, 3u}, {3u, 1u}, {1u, 0u}}) plc.triangles.push_back({a, b, 8});
  MeshOptions options = refining(0.3);
  options.lattice = Lattice::none;
  EXPECT_GE(least_angle_of_faces(mesh_plc(plc, options).mesh), 25);
}

TEST(Refine, TerminatesAtSmallAngles) {
  for (const double width : {1.0, 0.1, 0.001}) {
    SCOPED_TRACE(width);
    const Refined r = refined(wedge(width), 0.5);
    expect_exactly_in_place(r);
    EXPECT_LT(all_points(r.after).size(), 10000u);
  }
}

/// A pleated cone: segments from its tip to points around a circle, alternately convex and reflex.
InputPlc pleated_cone(int pleats) {
  InputPlc plc;
  plc.vertices = {{0, 0, 0}, {100, 0, 0}};
  const int points = 2 * pleats;
  for (int i = 0; i < points; ++i) {
    const double angle = to_radians(360.0 * i / points), radius = i % 2 == 0 ? 0.7 : 1;
    plc.vertices.push_back({100, radius * portable::cosine(angle), radius * portable::sine(angle)});
    const auto here = static_cast<std::uint32_t>(2 + i), next = static_cast<std::uint32_t>(2 + (i + 1) % points);
    plc.triangles.push_back({0, next, here});
    plc.triangles.push_back({1, here, next});
  }
  return plc;
}

TEST(Refine, SegmentsThatMeetAtSmallAnglesGetVerticesAtTheSameDistances) {
  const InputPlc plc = pleated_cone(20);
  MeshOptions options = refining(2.5);
  options.lattice = Lattice::none;
  const MeshResult r = mesh_plc(plc, options);
  EXPECT_GT(r.counts.refined_on_segments, 500u);
  EXPECT_EQ(r.counts.steiner_vertices, 0u);
  expect_verified(plc, r.mesh);
}

/// A segment from (0, 0, 0) to (1, 0, 0), and another one; both are protected.
std::vector<LeastDistances> close_segments(const Point3& from, const Point3& to) {
  constexpr double size = 0x1p50;
  plc::Plc plc;
  plc.vertices = {{0, 0, 0}, {size, 0, 0}};
  std::array<VertexId, 2> ends;
  for (int i = 0; i < 2; ++i) {
    const Point3 p = size * (i == 0 ? from : to);
    if (p == Point3{}) {
      ends[i] = VertexId(0);
      continue;
    }
    ends[i] = VertexId(plc.vertices.size());
    plc.vertices.push_back(p);
  }
  plc.segments = {{{VertexId(0), VertexId(1)}, 0, true}, {ends, 0, true}};
  return find_close_segments(plc);
}

TEST(Refine, SegmentsThatNearlyTouchSideBySideGetNoVertices) {
  const LeastDistances none = {no_vertices, no_vertices}, any = {no_small_angle, no_small_angle};
  EXPECT_EQ(close_segments({0, 5e-7, 0}, {1, 5e-7, 0}), (std::vector{none, none}));
  EXPECT_EQ(close_segments({0.5, 5e-7, 0}, {1.5, 5e-7, 0}), (std::vector{none, none}));
  EXPECT_EQ(close_segments({0, 1e-5, 0}, {1, 1e-5, 0}), (std::vector{any, any}));
  EXPECT_EQ(close_segments({0.5, 5e-7, -1}, {0.5, 5e-7, 1}), (std::vector{any, any})) << "they cross";
}

TEST(Refine, TheSmallerTheAngleTheFartherAreTheFirstVertices) {
  const auto least_at = [](double angle) {
    return close_segments({0, 0, 0}, {1, angle, 0})[0][0] / close_segments({0, 0, 0}, {1, 0.1, 0})[0][0];
  };
  // The longer segment's length over the squared sine.
  const auto expected = [](double angle) { return std::pow(1 + angle * angle, 1.5) / (angle * angle); };
  for (const double angle : {0.05, 0.01}) EXPECT_NEAR(least_at(angle), expected(angle) / expected(0.1), 1e-6);
  EXPECT_EQ(close_segments({0, 0, 0}, {0, 1, 0})[0], (LeastDistances{no_small_angle, no_small_angle}));
}

/// The definition of `find_fan_distances`: all pairs.
std::vector<double> distances_of_all_pairs(const std::vector<Spoke>& spokes) {
  const auto n = static_cast<std::uint32_t>(spokes.size());
  UnionFind fans(n);
  std::vector<double> largest(n, 0), result;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < i; ++j) {
      const Point3 &a = spokes[i].along, &b = spokes[j].along;
      const double squared_sine = squared_length(cross(a, b)) / (squared_length(a) * squared_length(b));
      if (dot(a, b) <= 0 || squared_sine >= 0.25) continue;
      const double step = std::max(spokes[i].step, spokes[j].step);
      fans.join(i, j);
      largest[i] = std::max(largest[i], spokes[i].grazeable && spokes[j].grazeable ? step / squared_sine : step);
    }
  for (std::uint32_t i = 0; i < n; ++i) largest[fans.find(i)] = std::max(largest[fans.find(i)], largest[i]);
  for (std::uint32_t i = 0; i < n; ++i) result.push_back(largest[fans.find(i)]);
  return result;
}

/// Segments with directions in some clusters, and different lengths.
std::vector<Spoke> random_spokes(std::uint64_t seed, int count, int clusters, double width) {
  std::uint64_t state = seed;
  const auto random = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 33) / 0x1p30 - 1;
  };
  const auto random_point = [&] {
    const double x = random(), y = random(), z = random();
    return Point3{x, y, z};
  };
  std::vector<Point3> centers;
  for (int i = 0; i < clusters; ++i) centers.push_back(random_point());
  std::vector<Spoke> spokes;
  for (int i = 0; i < count; ++i) {
    const Point3 direction = centers[i % clusters] + width * random_point();
    const double size = 1 + random();
    spokes.push_back({(0.01 + size) * direction, 0.01 + size, i % 3 != 0});
  }
  return spokes;
}

TEST(Refine, FansAreThoseOfAllPairs) {
  for (std::uint64_t seed = 0; seed < 40; ++seed)
    for (const int count : {1, 2, 7, 30, 200})
      for (const int clusters : {1, 4, 40}) {
        const std::vector<Spoke> spokes = random_spokes(seed, count, clusters, seed % 2 == 0 ? 0.5 : 1e-3);
        EXPECT_EQ(find_fan_distances(spokes), distances_of_all_pairs(spokes))
            << seed << ' ' << count << ' ' << clusters;
      }
}

TEST(Refine, FansOfManySegmentsTakeNearlyLinearTime) {
  const auto pairs_of = [](const std::vector<Spoke>& spokes) {
    const std::uint64_t pairs = work_done.box_pairs, nodes = work_done.box_tree_nodes;
    find_fan_distances(spokes);
    return work_done.box_pairs - pairs + work_done.box_tree_nodes - nodes;
  };
  constexpr int count = 20000;
  for (const int clusters : {1, 2, 1000})
    for (const double width : {1e-3, 0.5}) EXPECT_LT(pairs_of(random_spokes(1, count, clusters, width)), 40 * count);
  std::vector<Spoke> cone;  // all neighbors are equally near
  for (int i = 0; i < count; ++i) {
    const double angle = to_radians(360.0 * i / count);
    cone.push_back({{10, portable::cosine(angle), portable::sine(angle)}, 1, true});
  }
  EXPECT_LT(pairs_of(cone), 40 * count);
}

TEST(Refine, SegmentsAtVerySmallAnglesGetVerticesWhereTheirPiecesFit) {
  // Their directions differ by 0.0003, their lengths by up to 0.03.
  InputPlc plc = pleated_cone(20);
  for (std::size_t i = 2; i < plc.vertices.size(); ++i) {
    Point3& p = plc.vertices[i];
    p = {p.x + 0.03 * portable::sine(static_cast<double>(i * i)), 0.1 * p.y, 0.1 * p.z};
  }
  MeshOptions options = refining(2.5);
  options.lattice = Lattice::none;
  const MeshResult r = mesh_plc(plc, options);
  EXPECT_GT(r.counts.refined_on_segments, 1500u);
  EXPECT_LT(r.counts.steiner_vertices, r.counts.refined_on_segments);
  expect_verified(plc, r.mesh);
}

TEST(Refine, MeshesAreVerifiedAgainstTheOriginalInput) {
  for (const auto& [name, plc] : small_inputs()) {
    for (const InputPlc& input : {plc, rotated(oblique, plc)}) {
      SCOPED_TRACE(name);
      MeshOptions options = refining(0.5);
      expect_right(input, mesh_plc(input, options).mesh);
      options.lattice = Lattice::none;
      expect_verified(input, mesh_plc(input, options).mesh);
      options.improve.steiner = SteinerRule::remove;
      const MeshResult removed = mesh_plc(input, options);
      expect_right(input, removed.mesh);
      EXPECT_GE(removed.counts.vertices, input.vertices.size() + removed.counts.refined_on_segments);
    }
  }
}

TEST(Refine, StrategiesAgree) {
  const InputPlc plc = rotated(oblique, models::make_solid("bracket", 11));
  MeshOptions options = refining(5);
  options.improve.improvement = Improvement::none;
  const TetMesh usual = mesh_plc(plc, options).mesh;
  expect_verified(plc, usual);
  for (const LocatorKind locator : {LocatorKind::octree, LocatorKind::grid}) {
    options.locator = locator;
    options.face_protection = false;
    options.delaunay = DelaunayMethod::wrap;
    expect_same_cells(usual, mesh_plc(plc, options).mesh);
  }
}

TEST(Refine, ImprovementKeepsTheVerticesOfTheInput) {
  const InputPlc plc = models::make_solid("bracket", 11);
  const MeshResult r = mesh_plc(plc, refining(5));
  EXPECT_GT(r.counts.improve.moved_vertices, 0u);
  expect_right(plc, r.mesh);
}

}  // namespace
}  // namespace ccdt::refine
