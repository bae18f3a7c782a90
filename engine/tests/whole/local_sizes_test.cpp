#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "engine/base/errors.h"
#include "engine/mesher.h"
#include "engine/plc/build_plc.h"
#include "engine/sizes/region_shape.h"
#include "engine/surface/remesh_surface.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"

namespace ccdt {
namespace {

using mesh_test::oblique;

constexpr double fine = 0.06, coarse = 0.3;

/// A cube with a marker for each of its sides, from 1 to 6: two triangles each.
InputPlc marked_cube() {
  InputPlc cube = plc_test::box({0, 0, 0}, {2, 2, 2});
  for (std::size_t t = 0; t < cube.triangles.size(); ++t) cube.triangle_markers.push_back(1 + static_cast<int>(t / 2));
  return cube;
}

/// The mean length of the edges of tetrahedra whose middle is in a box.
double mean_length_in(const TetMesh& mesh, const Box& box) {
  double sum = 0, count = 0;
  for (const auto& t : mesh.tetrahedra)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) {
        const Point3 a = mesh.vertices[t[i]], b = mesh.vertices[t[j]];
        if (box.meets(box_of(0.5 * (a + b)))) sum += length(b - a), ++count;
      }
  return sum / count;
}

/// Meshes an input with local sizes by each way to get a surface, and checks that it is right and fine in one box and
/// coarse in the other.
void expect_fine_and_coarse(const InputPlc& input, const LocalSizes& local, const Box& fine_box,
                            const Box& coarse_box) {
  for (const SurfaceRule rule : {SurfaceRule::keep, SurfaceRule::refine, SurfaceRule::remesh}) {
    SCOPED_TRACE(name_of(rule));
    MeshOptions options{.surface = rule, .edge_length = coarse};
    options.local = local;
    options.sphere_factor = 0.1;  // the few triangles of a kept surface have spheres that would keep all points out
    const MeshResult result = mesh_plc(input, options);
    const InputPlc surface =
        rule == SurfaceRule::remesh ? surface::remesh_surface(input, {.edge_length = coarse, .local = &local}) : input;
    mesh_test::expect_right(surface, result.mesh);
    EXPECT_LT(mean_length_in(result.mesh, fine_box), 1.5 * fine);
    EXPECT_GT(mean_length_in(result.mesh, coarse_box), 0.6 * coarse);
  }
}

TEST(LocalSizes, HoldInABox) {
  LocalSizes local;
  local.sizes = {{.edge_length = fine, .boxes = {{{0.2, 0.2, 0.2}, {0.6, 0.6, 0.6}}}}};
  expect_fine_and_coarse(marked_cube(), local, {{0.2, 0.2, 0.2}, {0.6, 0.6, 0.6}}, {{1.5, 1.5, 1.5}, {2, 2, 2}});
}

TEST(LocalSizes, HoldInABall) {
  LocalSizes local;
  local.sizes = {{.edge_length = fine, .balls = {{{1, 1, 1}, 0.3}}}};
  expect_fine_and_coarse(marked_cube(), local, {{0.85, 0.85, 0.85}, {1.15, 1.15, 1.15}}, {{0, 0, 0}, {0.4, 0.4, 0.4}});
}

TEST(LocalSizes, HoldWithinADistanceOfAPoint) {
  LocalSizes local;
  local.sizes = {{.edge_length = fine, .balls = {{{1, 1, 1}, 0}}, .within = 0.3}};
  expect_fine_and_coarse(marked_cube(), local, {{0.85, 0.85, 0.85}, {1.15, 1.15, 1.15}}, {{0, 0, 0}, {0.4, 0.4, 0.4}});
}

TEST(LocalSizes, OfAFunctionHoldEverywhere) {
  LocalSizes local;
  local.function = [](std::span<const Point3> points, std::span<double> lengths) {
    for (std::size_t i = 0; i < points.size(); ++i)
      lengths[i] = length(points[i] - Point3{1, 1, 1}) < 0.4 ? fine : std::numeric_limits<double>::infinity();
  };
  expect_fine_and_coarse(marked_cube(), local, {{0.85, 0.85, 0.85}, {1.15, 1.15, 1.15}}, {{0, 0, 0}, {0.4, 0.4, 0.4}});
}

/// The mean length of the edges of faces with a marker.
double mean_length_of(const TetMesh& mesh, int marker) {
  double sum = 0, count = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (int i = 0; mesh.face_markers[f] == marker && i < 3; ++i)
      sum += length(mesh.vertices[mesh.faces[f][i]] - mesh.vertices[mesh.faces[f][(i + 1) % 3]]), ++count;
  return sum / count;
}

TEST(LocalSizes, OfAMarkerReachTheSurfaceThatIsMadeAnew) {
  for (const SurfaceRule rule : {SurfaceRule::refine, SurfaceRule::remesh})
    for (const bool by_name : {false, true}) {
      SCOPED_TRACE(name_of(rule));
      InputPlc cube = plc_test::rotated(oblique, marked_cube());
      cube.marker_names = {{2, "top"}};
      MeshOptions options{.surface = rule, .edge_length = coarse};
      options.local.sizes = {{.edge_length = fine}};
      if (by_name)
        options.local.sizes[0].names = {"top"};
      else
        options.local.sizes[0].markers = {2};
      const TetMesh mesh = mesh_plc(cube, options).mesh;
      EXPECT_LT(mean_length_of(mesh, 2), 1.3 * fine);
      EXPECT_GT(mean_length_of(mesh, 1), 0.6 * coarse);
    }
}

TEST(LocalSizes, OfABackgroundReachTheSurfaceThatIsMadeAnew) {
  for (const SurfaceRule rule : {SurfaceRule::refine, SurfaceRule::remesh}) {
    SCOPED_TRACE(name_of(rule));
    MeshOptions options{.surface = rule, .edge_length = coarse};
    options.background = {"", "", {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}}, {{0, 1, 2, 3}}, {fine, 1, 1, 1}};
    const TetMesh mesh = mesh_plc(marked_cube(), options).mesh;
    // Linear: fine + (1 - fine) * (x + y + z) / 9.
    EXPECT_LT(mean_length_in(mesh, {{0, 0, 0}, {0.2, 0.2, 0.2}}), 2 * fine);
    EXPECT_GT(mean_length_in(mesh, {{1.5, 1.5, 1.5}, {2, 2, 2}}), 0.7 * coarse);
  }
}

TEST(LocalSizes, AreTheSameOnAnyNumberOfThreads) {
  MeshOptions options{.surface = SurfaceRule::refine, .edge_length = coarse};
  options.local = {.name = "", .sizes = {{.edge_length = fine, .markers = {1}}}, .elements_through = 9};
  options.threads = 1;
  const TetMesh one = mesh_plc(marked_cube(), options).mesh;
  options.threads = 3;
  EXPECT_EQ(one.tetrahedra, mesh_plc(marked_cube(), options).mesh.tetrahedra);
}

TEST(LocalSizes, PutSeveralEdgesThroughThinParts) {
  const InputPlc plate = plc_test::box({0, 0, 0}, {2, 2, 0.2});
  for (const SurfaceRule rule : {SurfaceRule::refine, SurfaceRule::remesh}) {
    SCOPED_TRACE(name_of(rule));
    MeshOptions options{.surface = rule, .edge_length = coarse};
    options.local.elements_through = 3;
    const double mean = mean_length_in(mesh_plc(plate, options).mesh, {{0, 0, 0}, {2, 2, 0.2}});
    EXPECT_LT(mean, 1.3 * 0.2 / 3);
    EXPECT_GT(mean, 0.6 * 0.2 / 3);
  }
}

TEST(LocalSizes, FollowCurvature) {
  std::vector<std::array<double, 2>> polygon;
  for (int i = 0; i < 72; ++i) polygon.push_back({std::cos(i * M_PI / 36), std::sin(i * M_PI / 36)});
  const InputPlc cylinder = plc_test::prism(polygon);
  for (const double degrees : {5.0, 10.0}) {
    MeshOptions options{.surface = SurfaceRule::remesh, .edge_length = 1};
    options.local.curvature_angle = degrees;
    const TetMesh mesh = mesh_plc(cylinder, options).mesh;
    double sum = 0, count = 0;
    for (const auto& [a, b] : mesh.edges) {
      const Point3 p = mesh.vertices[a], q = mesh.vertices[b];
      if (std::hypot(p.x, p.y) > 0.99 && p.z == q.z) sum += length(q - p), ++count;
    }
    EXPECT_NEAR(sum / count, degrees * M_PI / 180, 0.3 * degrees * M_PI / 180);
  }
}

double volume_of(const TetMesh& mesh, std::size_t t) {
  const auto& [a, b, c, d] = mesh.tetrahedra[t];
  const Point3 origin = mesh.vertices[a];
  return dot(cross(mesh.vertices[b] - origin, mesh.vertices[c] - origin), mesh.vertices[d] - origin) / 6;
}

std::map<int, double> largest_volumes(const TetMesh& mesh) {
  std::map<int, double> largest;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    double& of_region = largest[mesh.regions.empty() ? 0 : mesh.regions[t]];
    of_region = std::max(of_region, volume_of(mesh, t));
  }
  return largest;
}

TEST(RegionVolumes, HoldForEachTetrahedron) {
  for (const SurfaceRule rule : {SurfaceRule::keep, SurfaceRule::refine, SurfaceRule::remesh})
    for (const Lattice lattice : {Lattice::fcc, Lattice::bcc, Lattice::sc, Lattice::refinement})
      for (const Improvement improvement : {Improvement::none, Improvement::all}) {
        SCOPED_TRACE(std::string(name_of(rule)) + " " + std::string(name_of(lattice)));
        InputPlc input = plc_test::rotated(oblique, mesh_test::two_cubes());
        ASSERT_EQ(input.regions.size(), 2u);
        input.regions[0].max_volume = 0.01;
        input.regions[1].max_volume = 0.003;
        MeshOptions options{.lattice = lattice, .surface = rule, .edge_length = 0.9};
        options.improve.improvement = improvement;
        const TetMesh mesh = mesh_plc(input, options).mesh;
        if (rule != SurfaceRule::remesh) mesh_test::expect_right(input, mesh);
        const auto largest = largest_volumes(mesh);
        EXPECT_LE(largest.at(input.regions[0].attribute), 0.01);
        EXPECT_LE(largest.at(input.regions[1].attribute), 0.003);
        EXPECT_GT(largest.at(input.regions[0].attribute), 0.003);
      }
}

TEST(RegionVolumes, AreTheOnlySizeOfARefinedSurfaceWithoutAnEdgeLength) {
  InputPlc input = mesh_test::two_cubes();
  for (auto& region : input.regions) region.max_volume = 0.02;
  MeshOptions options{.surface = SurfaceRule::refine};
  const TetMesh mesh = mesh_plc(input, options).mesh;
  mesh_test::expect_right(input, mesh);
  for (const auto& [region, largest] : largest_volumes(mesh)) {
    EXPECT_LE(largest, 0.02);
    EXPECT_GT(largest, 0.005) << "much finer than wanted";
  }
}

TEST(RegionVolumes, AreThoseOfOptionsToo) {
  InputPlc input = mesh_test::two_cubes();
  MeshOptions options{.surface = SurfaceRule::refine, .edge_length = 0.5};
  options.local.sizes = {{.volume = 0.0005, .regions = {input.regions[1].attribute}}};
  const auto largest = largest_volumes(mesh_plc(input, options).mesh);
  EXPECT_LE(largest.at(input.regions[1].attribute), 0.0005);
  EXPECT_GT(largest.at(input.regions[0].attribute), 0.002);
}

TEST(RegionShape, KnowsWhereTheRegionIs) {
  const plc::Plc plc = plc::build_plc(mesh_test::cube_within_cube());
  for (std::uint32_t r = 1; r < plc.regions.size(); ++r) {
    const sizes::RegionShape shape(plc, RegionId(r));
    double volume = 0;
    constexpr double side = 0x1p47;  // in grid units: a thirty-second of the box
    sizes::cover(
        sizes::cube_around(shape.bounds()), side, [&](const Box& cube) { return shape.filling_of(cube); },
        [&](const Box& cube) { volume += std::pow(plc.grid.unit * (cube.high.x - cube.low.x), 3); });
    const double inside = plc_test::volume(plc, r);
    EXPECT_GT(volume, 0.999 * inside);
    EXPECT_LT(volume, 2.5 * inside);
  }
}

TEST(LocalSizes, ThatNothingInTheInputHasAreRefused) {
  const auto expect_refused = [](const LocalSize& size) {
    MeshOptions options;
    options.local.sizes = {size};
    EXPECT_THROW(mesh_plc(marked_cube(), options), InputError);
  };
  expect_refused({.edge_length = 1, .markers = {9}});
  expect_refused({.edge_length = 1, .names = {"inlet"}});
  expect_refused({.edge_length = 1, .segments = {9}});
  expect_refused({.edge_length = 1, .regions = {9}});
  expect_refused({.volume = 1, .regions = {9}});
  expect_refused({});
  expect_refused({.edge_length = std::nan("")});
  expect_refused({.edge_length = -1});
  expect_refused({.edge_length = 1, .boxes = {{{0, 0, 0}, {-1, 1, 1}}}});
  expect_refused({.edge_length = 1, .balls = {{{0, 0, 0}, -1}}});
  MeshOptions options;
  options.local.function = [](std::span<const Point3>, std::span<double> lengths) { lengths[0] = 0; };
  EXPECT_THROW(mesh_plc(marked_cube(), options), InputError);
  options.local.function = [](std::span<const Point3>, std::span<double> lengths) { std::ranges::fill(lengths, 1e-9); };
  EXPECT_THROW(mesh_plc(marked_cube(), options), LimitError);
  options.local.function = {};
  options.local.sizes = {{.edge_length = 1e-9, .markers = {1}}};
  EXPECT_THROW(mesh_plc(marked_cube(), options), LimitError);
  options.local.sizes = {{.edge_length = 1, .markers = {1}}};
  options.grading = 0;
  EXPECT_THROW(mesh_plc(marked_cube(), options), InputError);
}

}  // namespace
}  // namespace ccdt
