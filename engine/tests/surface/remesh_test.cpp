#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

// after GoogleTest, whose macros it uses
#include "engine/base/count_work.h"
#include "engine/base/errors.h"
#include "engine/io/plc_files.h"
#include "engine/mesher.h"
#include "engine/surface/prepare_surface.h"
#include "engine/surface/remesh_surface.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tests/shared/real_parts.h"
#include "engine/tests/shared/sanitized.h"
#include "engine/tests/surface/remesh_measures.h"
#include "models/solids.h"

namespace ccdt {
namespace {

using namespace mesh_test;
using namespace remesh_test;

InputPlc remeshed(const InputPlc& input, double edge_length, double sharp_angle = 30) {
  surface::RemeshOptions options;
  options.edge_length = edge_length, options.sharp_angle = sharp_angle;
  return surface::remesh_surface(input, options);
}

/// A square plate with narrow slots that reach nearly through it, with needles between them.
InputPlc slotted_plate(int slots) {
  std::vector<std::array<double, 2>> outline = {{0, 0}, {1, 0}, {1, 1}};
  for (int i = slots - 1; i >= 0; --i) {
    const double x = (i + 0.5) / slots;
    outline.insert(outline.end(), {{x + 0.002, 1}, {x + 0.002, 0.03}, {x - 0.002, 0.03}, {x - 0.002, 1}});
  }
  outline.push_back({0, 1});
  const auto n = static_cast<std::uint32_t>(outline.size());
  InputPlc plate;
  std::vector<std::uint32_t> bottom, top;
  for (const double z : {0.0, 0.05})
    for (const auto& [x, y] : outline) plate.vertices.push_back({x, y, z});
  for (std::uint32_t i = 0; i < n; ++i) {
    bottom.push_back(n - 1 - i);
    top.push_back(n + i);
    plc_test::append_fan(plate, {i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  for (const auto& polygon : {bottom, top}) {
    PolygonFacet facet;
    facet.polygons = {polygon};
    plate.polygon_facets.push_back(facet);
  }
  return plate;
}

/// For flat facets: everything but the triangles stays the same, up to rounding.
void expect_same_shape(const InputPlc& before, const InputPlc& after) {
  expect_near(areas(before), areas(after), 1e-9);
  expect_near(non_manifold_edge_lengths(before), non_manifold_edge_lengths(after), 1e-9);
  expect_near(segment_lengths(before), segment_lengths(after), 1e-9);
  const plc::Plc a = plc::build_plc(before), b = plc::build_plc(after);
  EXPECT_EQ(a.regions.size(), b.regions.size());
  EXPECT_EQ(a.facets.size(), b.facets.size());
  expect_near(region_volumes(a), region_volumes(b), 1e-9);
}

TEST(Remeshing, CubeKeepsItsEdgesItsVolumeAndItsFlatFaces) {
  for (const double h : {0.05, 0.1, 0.23, 0.5, 3.0}) {
    SCOPED_TRACE(h);
    const InputPlc cube = remeshed(unit_cube(), h);
    expect_same_shape(unit_cube(), cube);
    EXPECT_NEAR(sharp_length(cube, 30), 12, 1e-12);
    for (const auto& [a, b, c] : cube.triangles) {
      const Point3 &p = cube.vertices[a], &q = cube.vertices[b], &r = cube.vertices[c];
      EXPECT_TRUE((p.x == q.x && q.x == r.x) || (p.y == q.y && q.y == r.y) || (p.z == q.z && q.z == r.z));
    }
    if (h >= 0.5) continue;
    EXPECT_GE(share_of_good_edges(cube, h), 0.9);
    EXPECT_GE(smallest_angle_of_99_percent(cube), 25);
  }
}

TEST(Remeshing, RotatedCubeStaysFlatWithinTheTolerance) {
  const InputPlc cube = rotated(oblique, unit_cube());
  expect_same_shape(cube, remeshed(cube, 0.1));
}

TEST(Remeshing, DenseSurfacesAreCoarsened) {
  const InputPlc cube = remeshed(gridded_cube(20), 0.4);
  expect_near(areas(gridded_cube(20)), areas(cube), 1e-12);
  EXPECT_NEAR(sharp_length(cube, 30), 12, 1e-12);
  EXPECT_LT(cube.triangles.size(), 12u * 20);
  EXPECT_GE(share_of_good_edges(cube, 0.4), 0.8);
}

TEST(Remeshing, InteriorFacetsSlitsAndDanglingFacetsStay) {
  for (const InputPlc& plc : {two_cubes(), two_cubes_as_surface(), cube_within_cube(), cube_with_slit(),
                              cube_with_dangling_facet(), cube_with_turnstile()})
    for (const double h : {0.2, 0.7}) {
      SCOPED_TRACE(h);
      const InputPlc result = remeshed(plc, h);
      expect_same_shape(plc, result);
      EXPECT_GT(result.triangles.size(), plc.triangles.size());
    }
}

TEST(Remeshing, EdgesAndVerticesOfEveryKindStay) {
  std::mt19937 random(7);
  for (int round = 0; round < 6; ++round) {
    SCOPED_TRACE(round);
    const InputPlc plc = random_voxels(3, 3, random);
    expect_same_shape(plc, remeshed(plc, round % 2 ? 0.45 : 2));
    const InputPlc turned = rotated(random_rotation(random), plc);
    expect_same_shape(turned, remeshed(turned, 0.45));
  }
}

TEST(Remeshing, MarkersStayWhereTheyAre) {
  InputPlc plc = two_cubes();
  for (std::size_t t = 0; t < plc.triangles.size(); ++t)
    plc.triangle_markers.push_back(static_cast<int>(t / 2 + t % 3));
  expect_same_shape(plc, remeshed(plc, 0.2));
}

TEST(Remeshing, SegmentsKeepTheirMarkersAndAreDivided) {
  InputPlc plc = cube_with_dangling_segment();
  plc.segments.push_back({0, 3});  // a diagonal of the bottom
  plc.segment_markers = {5, 6};
  const InputPlc result = remeshed(plc, 0.3);
  expect_same_shape(plc, result);
  EXPECT_GT(result.segments.size(), 15u);
}

TEST(Remeshing, SegmentOfASingleEdgeWithinAFaceStays) {
  InputPlc plc = gridded_cube(4);
  plc.segments = {{6, 7}};  // inner vertices of the first face
  plc.segment_markers = {9};
  for (const double h : {0.1, 0.25, 1.0}) {
    SCOPED_TRACE(h);
    expect_near(segment_lengths(plc), segment_lengths(remeshed(plc, h)), 1e-12);
  }
}

TEST(Remeshing, VerticesThatTheInputListsAloneStay) {
  InputPlc plc = seeded_cube();
  const std::vector<Point3> alone = {{1, 1, 1.5}, {1.25, 0.75, 3}, {0, 0, 1.125}};  // inside, on a face, on an edge
  plc.vertices.insert(plc.vertices.end(), alone.begin(), alone.end());
  const InputPlc result = remeshed(plc, 0.5);
  for (const Point3& p : alone) EXPECT_EQ(std::count(result.vertices.begin(), result.vertices.end(), p), 1);
  EXPECT_NEAR(inside_volume(plc::build_plc(result)), 27, 1e-9);
}

TEST(Remeshing, SphereStaysRound) {
  const double made = is_sanitized ? 0.1 : 0.05;
  const InputPlc plc = models::make_solid("sphere", made);
  const double before = inside_volume(plc::build_plc(plc));
  for (const double h : {0.04, 0.08, 0.15}) {
    if (is_sanitized && h < made / 2) continue;
    SCOPED_TRACE(h);
    const InputPlc result = remeshed(plc, h);
    EXPECT_NEAR(inside_volume(plc::build_plc(result)), before, 0.01 * before);
    EXPECT_EQ(sharp_length(result, 30), 0);
    EXPECT_GE(share_of_good_edges(result, h), 0.9);
    EXPECT_GE(smallest_angle_of_99_percent(result), 25);
  }
}

TEST(Remeshing, RimOfACylinderStaysRound) {
  constexpr int sides = 64;
  std::vector<std::array<double, 2>> circle;
  for (int i = 0; i < sides; ++i)
    circle.push_back({std::cos(2 * std::acos(-1.0) * i / sides), std::sin(2 * std::acos(-1.0) * i / sides)});
  const InputPlc cylinder = prism(circle);
  const double before = inside_volume(plc::build_plc(cylinder));
  for (const double h : {0.1, 0.2, 1.0, 5.0}) {
    if (is_sanitized && h < 0.2) continue;
    SCOPED_TRACE(h);
    const InputPlc result = remeshed(cylinder, h);
    EXPECT_NEAR(sharp_length(result, 60), sharp_length(cylinder, 60), 0.01 * sharp_length(cylinder, 60));
    EXPECT_NEAR(inside_volume(plc::build_plc(result)), before, (h < 0.5 ? 0.005 : 0.03) * before);
    for (const Point3& p : result.vertices) EXPECT_LE(std::hypot(p.x, p.y), 1 + 1e-12);
  }
}

TEST(Remeshing, ConeKeepsItsTipAndGetsEvenTriangles) {
  constexpr double h = 0.1;
  for (const double height : {0.9, 2.0, 4.0})
    for (const int sides : {32, 256})
      for (const double sharp_angle : {30, 60}) {
        if (is_sanitized && sides > 32) continue;
        SCOPED_TRACE("height " + std::to_string(height) + ", " + std::to_string(sides) + " sides");
        const InputPlc before = double_cone(sides, height, 0), after = remeshed(before, h, sharp_angle);
        EXPECT_NE(std::ranges::find(after.vertices, Point3{0, 0, height}), after.vertices.end());
        EXPECT_NEAR(inside_volume(plc::build_plc(after)), inside_volume(plc::build_plc(before)), 0.01 * height);
        EXPECT_LE(after.triangles.size(), 1.5 * (areas(before)[0] / (std::sqrt(3) / 4 * h * h)));
        EXPECT_GE(smallest_angle_of_99_percent(after), 25);
      }
}

TEST(Remeshing, ModelsReachTheirEdgeLength) {
  for (const auto& [name, h] : {std::pair{"piston", 5.0}, {"bracket", 5.0}, {"stepping-pole", 2.5}}) {
    if (is_sanitized && h == 2.5) continue;
    SCOPED_TRACE(name);
    const InputPlc plc = models::make_solid(name, h), result = remeshed(plc, h);
    const double before = inside_volume(plc::build_plc(plc));
    EXPECT_NEAR(inside_volume(plc::build_plc(result)), before, 0.005 * before);
    EXPECT_NEAR(sharp_length(result, 30), sharp_length(plc, 30), 0.02 * sharp_length(plc, 30));
    EXPECT_GE(share_of_good_edges(result, h), 0.6);  // fillets and bores need shorter ones
    EXPECT_GE(smallest_angle_of_99_percent(result), 35);
  }
}

TEST(Remeshing, ShellsThinnerThanTheEdgesDoNotCross) {
  InputPlc shell = models::make_solid("sphere", 0.1);
  const auto shrunk = [](const Point3& p) { return 0.997 * p; };  // so thin that it gets no shorter edges
  append(shell, rotated(oblique, mapped(shell, shrunk)));
  shell.triangle_markers.clear();
  std::uint64_t attempts = 0;
  const std::uint64_t rounds_before = work_done.remesh_rounds;
  surface::RemeshOptions options;
  options.edge_length = 0.6;
  const InputPlc result = surface::remesh_surface(
      shell, options,
      [&](std::string_view stage, std::uint64_t done, std::uint64_t) { attempts += stage == "remesh" && done == 0; });
  EXPECT_GT(attempts, 1u);  // else this tests nothing
  EXPECT_EQ(work_done.remesh_rounds - rounds_before, 8 + 3 * (attempts - 1)) << "crossings are repaired locally";
  EXPECT_GE(std::ranges::min(smallest_angles(result)), 30);
  const plc::Plc before = plc::build_plc(shell), after = plc::build_plc(result);
  EXPECT_EQ(after.regions.size(), before.regions.size());
  EXPECT_NEAR(inside_volume(after), inside_volume(before), 0.3 * inside_volume(before));
}

TEST(Remeshing, NoTriangleHasASmallAngleWhereNoFeatureForbidsIt) {
  for (const auto& [name, made, h] : {std::tuple{"sphere", 0.05, 0.08},
                                      {"torus", 0.05, 0.06},
                                      {"cube", 0.2, 0.11},
                                      {"piston", 5.0, 5.0},
                                      {"stepping-pole", 2.5, 2.5},
                                      {"stepping-pole", 2.5, 5.0}}) {
    if (is_sanitized && h == 2.5) continue;
    SCOPED_TRACE(std::string(name) + " " + std::to_string(h));
    EXPECT_GE(smallest_angles(remeshed(models::make_solid(name, made), h)).front(), 30);
  }
}

TEST(Remeshing, EdgesGrowGentlyFromShortFeatures) {
  const InputPlc block = prism({{0, 0}, {2, 0}, {2, 0.95}, {1.95, 1}, {0, 1}});  // a chamfer far below the edge length
  const InputPlc result = remeshed(block, 0.5);
  expect_same_shape(block, result);
  EXPECT_GE(smallest_angles(result).front(), 30);
}

TEST(Remeshing, EdgesAlongAStripFitItsWidth) {
  const InputPlc plate = prism({{0, 0}, {2, 0}, {2, 0.04}, {0, 0.04}});
  const InputPlc result = remeshed(plate, 0.5);
  expect_same_shape(plate, result);
  EXPECT_GE(smallest_angles(result).front(), 30);
}

/// The worst r (paper, section 6) of the tetrahedra that the mesher makes from a surface.
double worst_r(const InputPlc& surface, double edge_length) {
  MeshOptions options;
  options.edge_length = edge_length;
  const TetMesh mesh = mesh_plc(surface, options).mesh;
  double worst = 0;
  for (const auto& [a, b, c, d] : mesh.tetrahedra) {
    const std::array<Point3, 4> p = {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], mesh.vertices[d]};
    double squares = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) squares += squared_length(p[i] - p[j]);
    const double volume = dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) / 6;
    worst = std::max(worst, std::pow(squares / 6, 1.5) / (8.48528 * volume));
  }
  return worst;
}

TEST(RemeshedThinParts, EdgesFitTheThicknessOfAPlate) {
  for (const double thickness : {0.05, 0.02}) {
    SCOPED_TRACE(thickness);
    const InputPlc plate = box({0, 0, 0}, {1, 1, thickness});
    for (const InputPlc& turned : {plate, rotated(oblique, plate)}) {
      const InputPlc result = remeshed(turned, 0.1);
      expect_same_shape(turned, result);
      EXPECT_LE(mean_edge_length(result), 2.2 * thickness);
      EXPECT_LE(worst_r(result, 0.1), 4);
    }
  }
}

TEST(RemeshedThinParts, ExtremelyThinPlatesAreRemeshed) {
  for (const double height : {4e-3, 4e-6, 4e-9}) {
    if (is_sanitized && height < 1e-6) continue;
    SCOPED_TRACE(height);
    for (const InputPlc& plate : {gridded_plate(4, height), rotated(oblique, gridded_plate(4, height))}) {
      const InputPlc result = remeshed(plate, 0.3);
      EXPECT_NEAR(inside_volume(plc::build_plc(result)), inside_volume(plc::build_plc(plate)), 1e-6 * 16 * height);
      if (height > 1e-6) {
        EXPECT_GT(mesh_plc(result).counts.tetrahedra, 0u);
      }
    }
  }
}

TEST(RemeshedThinParts, PlatesTooThinForAnyEdgesGetUsualEdges) {
  const InputPlc result = remeshed(box({0, 0, 0}, {1, 1, 1e-5}), 0.1);
  EXPECT_LT(result.triangles.size(), 4000u);
}

TEST(RemeshedThinParts, FlatGapsNeedNoShortEdges) {
  InputPlc plc = box({0, 0, 0}, {1, 1, 1});
  append(plc, box({0, 0, 1.02}, {1, 1, 2}));
  const InputPlc alone = remeshed(box({0, 0, 0}, {1, 1, 1}), 0.2), both = remeshed(plc, 0.2);
  EXPECT_LT(both.triangles.size(), 2.2 * static_cast<double>(alone.triangles.size()));
}

TEST(RemeshedThinParts, NoiseIsNotAThinFeature) {
  InputPlc sphere = models::make_solid("sphere", 0.05);
  const std::size_t smooth = remeshed(sphere, 0.15).triangles.size();
  std::mt19937 random(3);
  for (Point3& p : sphere.vertices) p = (1 + 0.004 * (static_cast<double>(random() % 1000) / 1000 - 0.5)) * p;
  EXPECT_LT(static_cast<double>(remeshed(sphere, 0.15).triangles.size()), 1.1 * static_cast<double>(smooth));
}

// Needles between a long slot and the border: splits of edges that are not the longest would never end.
TEST(RemeshedThinParts, SlottedPlatesStaySmall) {
  const InputPlc plate = slotted_plate(12);
  const InputPlc result = remeshed(plate, 0.1);
  EXPECT_NEAR(inside_volume(plc::build_plc(result)), inside_volume(plc::build_plc(plate)), 1e-9);
  EXPECT_LT(result.triangles.size(), 30000u);
}

TEST(Remeshing, IsDeterministic) {
  const InputPlc plc = models::make_solid("bracket", 7);
  const InputPlc a = remeshed(plc, 5), b = remeshed(plc, 5);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(Remeshing, RejectsOptionsOutOfRange) {
  EXPECT_THROW(remeshed(unit_cube(), 0), InputError);
  EXPECT_THROW(remeshed(unit_cube(), -1), InputError);
  EXPECT_THROW(remeshed(unit_cube(), std::nan("")), InputError);
}

/// A cube of six polygons with one corner moved, so that three of them are warped.
InputPlc warped_cube() {
  InputPlc cube;
  cube.vertices = plc_test::unit_cube().vertices;
  cube.vertices.back() = {1.1, 1.2, 1.4};
  for (const auto& corners : std::vector<std::vector<std::uint32_t>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    PolygonFacet facet;
    facet.polygons = {corners};
    facet.number = static_cast<std::uint32_t>(cube.polygon_facets.size());
    cube.polygon_facets.push_back(facet);
  }
  return cube;
}

TEST(SurfaceRule, RemeshMeshesTheRemeshedSurface) {
  const InputPlc cube = plc_test::unit_cube();
  MeshOptions options;
  options.edge_length = 0.3;
  const MeshResult expected = mesh_plc(remeshed(cube, 0.3), options);
  options.surface = SurfaceRule::remesh;
  const MeshResult result = mesh_plc(cube, options);
  EXPECT_EQ(result.mesh.tetrahedra, expected.mesh.tetrahedra);
  EXPECT_EQ(result.mesh.vertices, expected.mesh.vertices);
  EXPECT_GT(result.costs[Stage::remesh].seconds, 0);
  double seconds = 0;
  for (const StageCost& cost : result.costs.stages) seconds += cost.seconds;
  EXPECT_NEAR(result.costs.mesh_seconds, seconds - result.costs[Stage::remesh].seconds, 1e-9);
}

TEST(SurfaceRule, RemeshNeedsAnEdgeLengthThatIsPossible) {
  MeshOptions options;
  options.surface = SurfaceRule::remesh;
  EXPECT_THROW(mesh_plc(plc_test::unit_cube(), options), InputError);
  options.edge_length = 1e-9;
  EXPECT_THROW(mesh_plc(plc_test::unit_cube(), options), LimitError);
}

TEST(SurfaceRule, RemeshUsesTheSharpAngle) {
  MeshOptions options;
  options.surface = SurfaceRule::remesh, options.edge_length = 0.4;
  const InputPlc cube = plc_test::unit_cube();
  const MeshResult with_edges = mesh_plc(cube, options);
  options.sharp_angle = 170;
  EXPECT_NE(with_edges.mesh.vertices, mesh_plc(cube, options).mesh.vertices);
}

TEST(PreparedSurface, HasTheWarpedPolygonsOfTheInputAndItsFacetsBeforeRemeshing) {
  for (const SurfaceRule rule : {SurfaceRule::keep, SurfaceRule::remesh, SurfaceRule::refine}) {
    const surface::PreparedSurface made = surface::prepare_surface(warped_cube(), rule, {.edge_length = 0.4});
    ASSERT_TRUE(made.changed);
    EXPECT_EQ(made.changed->warped.count, 3u);
    EXPECT_EQ(made.facets, 9u);
    EXPECT_EQ(made.changed->facet_count() > 9, rule == SurfaceRule::remesh);
    EXPECT_EQ(made.edge_length, 0.4);
  }
}

TEST(PreparedSurface, BoundsTheEdgeLengthByTheSizeOfTheInput) {
  const InputPlc cube = plc_test::unit_cube();
  const auto length = [&](SurfaceRule rule, double given) {
    return surface::prepare_surface(cube, rule, {.edge_length = given}).edge_length;
  };
  EXPECT_NEAR(length(SurfaceRule::keep, 100), std::sqrt(3), 1e-12);
  EXPECT_EQ(length(SurfaceRule::keep, 0), 0);
  EXPECT_NEAR(length(SurfaceRule::refine, 0), std::sqrt(3) / 40, 1e-12);
  EXPECT_FALSE(surface::prepare_surface(cube, SurfaceRule::keep, {}).changed);
}

TEST(RemeshedParts, MeshAtEveryEdgeLengthAndKeepTheirVolume) {
  const auto files = real_parts();
  if (files.empty()) GTEST_SKIP() << "no parts here; CCDT_PARTS names their folder";
  for (const auto& file : files) {
    const std::string name = file.stem().string();
    if (name != "cheese" && name != "fandisk" && name != "joint" && name != "elephant") continue;
    const InputPlc input = io::read_plc(file);
    const double before = inside_volume(plc::build_plc(input));
    for (const double factor : {1.0, 2.0, 4.0}) {
      if (name == "cheese" && factor != 2) continue;  // its bores take seconds
      if (is_sanitized && (name != "joint" || factor != 2)) continue;
      SCOPED_TRACE(name + " " + std::to_string(factor));
      const InputPlc result = remeshed(input, factor * mean_edge_length(input));
      EXPECT_NEAR(inside_volume(plc::build_plc(result)), before, 0.02 * factor * before);
      if (name == "cheese") continue;  // the mesher takes many seconds for it
      MeshOptions options;
      options.lattice = Lattice::none;
      EXPECT_GT(mesh_plc(result, options).counts.tetrahedra, 0u);
    }
  }
}

TEST(RemeshedParts, BoresAndFilletsNarrowerThanTheEdgesMakeNoNeedles) {
  const auto files = real_parts();
  if (files.empty()) GTEST_SKIP() << "no parts here; CCDT_PARTS names their folder";
  for (const auto& file : files) {
    const std::string name = file.stem().string();
    if (name != "anchor" && name != "joint" && name != "pinion" && name != "rotor") continue;
    SCOPED_TRACE(name);
    const InputPlc input = io::read_plc(file), result = remeshed(input, mean_edge_length(input));
    EXPECT_GE(smallest_angles(result).front(), 30);
    const double before = inside_volume(plc::build_plc(input));
    EXPECT_NEAR(inside_volume(plc::build_plc(result)), before, 0.005 * before);
    MeshOptions options;
    options.lattice = Lattice::none;
    EXPECT_GT(mesh_plc(result, options).counts.tetrahedra, 0u);
  }
}

}  // namespace
}  // namespace ccdt
