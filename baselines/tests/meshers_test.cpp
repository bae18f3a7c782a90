#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "baselines/mesher.h"
#include "baselines/tests/plain_options.h"
#include "baselines/tests/shapes.h"
#include "engine/base/errors.h"

namespace ccdt {
namespace {

double volume(const TetMesh& mesh) {
  double total = 0;
  for (const auto& t : mesh.tetrahedra) {
    const auto& v = mesh.vertices;
    const double part = dot(cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]), v[t[3]] - v[t[0]]) / 6;
    EXPECT_GT(part, 0);
    total += part;
  }
  return total;
}

bool has(std::string_view name) {
  return std::ranges::find(baselines::meshers(), name, &baselines::Mesher::name) != baselines::meshers().end();
}

baselines::MesherRun run(std::string_view name, const InputPlc& plc, const MeshOptions& options) {
  return baselines::mesher(name).run(plc, options, {});
}

TEST(Meshers, OursIsFirst) {
  EXPECT_EQ(baselines::meshers().front().name, "ccdt");
}

TEST(Meshers, UnknownNameIsAnErrorThatListsTheKnownOnes) {
  try {
    baselines::mesher("nobody");
    FAIL() << "no such mesher";
  } catch (const Error& error) {
    EXPECT_NE(error.remedy().find("ccdt"), std::string::npos);
  }
}

TEST(TetGen, MeshesACubeWithoutNewVertices) {
  if (!has("tetgen")) GTEST_SKIP() << "built without TetGen";
  const baselines::MesherRun made = run("tetgen", shapes::with_repeated_vertices(shapes::cube()), bare);
  EXPECT_NEAR(volume(made.result.mesh), 1, 1e-12);
  EXPECT_EQ(made.result.counts.vertices, 8u);
  EXPECT_EQ(made.result.counts.steiner_vertices, 0u);
  EXPECT_EQ(made.settings.at(0).second, "pQ");
  EXPECT_GT(made.result.costs.mesh_seconds, 0);
}

TEST(TetGen, RefinesToTheEdgeLengthWhenThereAreInteriorPoints) {
  if (!has("tetgen")) GTEST_SKIP() << "built without TetGen";
  const baselines::MesherRun made = run("tetgen", shapes::cube_with_grid(5), unimproved(0.2));
  EXPECT_NEAR(volume(made.result.mesh), 1, 1e-12);
  EXPECT_GT(made.result.counts.interior_vertices, 20u);
  EXPECT_EQ(made.result.counts.steiner_vertices, 0u);
  EXPECT_EQ(made.settings.at(0).second.substr(0, 12), "pYq1.414/10a");
  EXPECT_GE(static_cast<double>(made.result.counts.tetrahedra), 3 * std::sqrt(2.0) / (0.2 * 0.2 * 0.2));
}

TEST(TetGen, LeavesAClosedShellWithinASurfaceEmpty) {
  if (!has("tetgen")) GTEST_SKIP() << "built without TetGen";
  const baselines::MesherRun made = run("tetgen", shapes::cube_with_hole(), bare);
  EXPECT_NEAR(volume(made.result.mesh), 26, 1e-9);
}

TEST(TetGen, KeepsRegionsAndMarkers) {
  if (!has("tetgen")) GTEST_SKIP() << "built without TetGen";
  InputPlc plc = shapes::cube_with_hole();
  plc.inside = InputPlc::Inside::seeds;
  plc.triangle_markers.assign(24, 7);
  plc.regions = {{{0.5, 0.5, 0.5}, 3, 0}, {{1.5, 1.5, 1.5}, 4, 0}};
  const baselines::MesherRun made = run("tetgen", plc, bare);
  EXPECT_NEAR(volume(made.result.mesh), 27, 1e-9);
  EXPECT_GT(std::ranges::count(made.result.mesh.regions, 3), 0);
  EXPECT_GT(std::ranges::count(made.result.mesh.regions, 4), 0);
  EXPECT_TRUE(std::ranges::all_of(made.result.mesh.face_markers, [](int marker) { return marker == 7; }));
}

TEST(TetGen, SelfIntersectionBecomesAMeshErrorAndPrintsNothing) {
  if (!has("tetgen")) GTEST_SKIP() << "built without TetGen";
  InputPlc plc;
  shapes::add_cube(plc, 0, 2);
  shapes::add_cube(plc, 1, 3);
  testing::internal::CaptureStdout();
  EXPECT_THROW(run("tetgen", plc, bare), MeshError);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(TetGen, OpenSurfaceBecomesAMeshError) {
  if (!has("tetgen")) GTEST_SKIP() << "built without TetGen";
  InputPlc plc = shapes::cube();
  plc.triangles.pop_back();
  EXPECT_THROW(run("tetgen", plc, bare), MeshError);
}

TEST(CgalDelaunay, FillsTheConvexHullOfTheVertices) {
  if (!has("cgal-delaunay")) GTEST_SKIP() << "built without CGAL's meshers";
  const baselines::MesherRun made = run("cgal-delaunay", shapes::cube_with_hole(), bare);
  EXPECT_NEAR(volume(made.result.mesh), 27, 1e-9);
  EXPECT_EQ(made.result.counts.vertices, 16u);
  EXPECT_EQ(made.result.costs[Stage::delaunay].seconds, made.result.costs.mesh_seconds);
}

TEST(CgalDelaunay, OfVerticesInAPlaneIsAMeshError) {
  if (!has("cgal-delaunay")) GTEST_SKIP() << "built without CGAL's meshers";
  InputPlc plc;
  plc.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_THROW(run("cgal-delaunay", plc, bare), MeshError);
}

TEST(CgalMesh3, MeshesACubeWithAHoleKeepingItsSharpEdges) {
  if (!has("cgal-mesh3")) GTEST_SKIP() << "built without CGAL's meshers";
  const baselines::MesherRun made = run("cgal-mesh3", shapes::cube_with_hole(), unimproved(0.6));
  EXPECT_NEAR(volume(made.result.mesh), 26, 1e-6);
  EXPECT_GT(made.result.mesh.edges.size(), 24u);
  EXPECT_FALSE(made.settings.empty());
}

/// The value of a setting, or nothing.
std::string setting(const baselines::MesherRun& run, std::string_view name) {
  const auto found = std::ranges::find(run.settings, name, [](const auto& s) { return std::string_view(s.first); });
  return found == run.settings.end() ? "" : found->second;
}

TEST(CgalMesh3, PerturbsAndExudesUnlessImprovementIsOff) {
  if (!has("cgal-mesh3")) GTEST_SKIP() << "built without CGAL's meshers";
  MeshOptions options = {.edge_length = 0.25};
  const auto worst_volume = [](const TetMesh& mesh) {
    double least = 1;
    for (const auto& t : mesh.tetrahedra) {
      const auto& v = mesh.vertices;
      least = std::min(least, dot(cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]), v[t[3]] - v[t[0]]) / 6);
    }
    return least;
  };
  options.improve.improvement = Improvement::all;
  const baselines::MesherRun improved = run("cgal-mesh3", shapes::cube(), options);
  options.improve.improvement = Improvement::none;
  const baselines::MesherRun refined = run("cgal-mesh3", shapes::cube(), options);
  EXPECT_EQ(setting(improved, "perturb") + setting(improved, "exude"), "onon");
  EXPECT_EQ(setting(refined, "perturb") + setting(refined, "exude"), "offoff");
  EXPECT_GT(worst_volume(improved.result.mesh), worst_volume(refined.result.mesh));  // slivers are gone
}

TEST(CgalMesh3, GivesEachRegionItsAttribute) {
  if (!has("cgal-mesh3")) GTEST_SKIP() << "built without CGAL's meshers";
  InputPlc plc = shapes::cube_with_hole();
  plc.inside = InputPlc::Inside::seeds;
  plc.regions = {{{0.5, 0.5, 0.5}, 3, 0}, {{1.5, 1.5, 1.5}, 4, 0}};
  const baselines::MesherRun made = run("cgal-mesh3", plc, unimproved(0.6));
  EXPECT_NEAR(volume(made.result.mesh), 27, 1e-6);
  EXPECT_GT(std::ranges::count(made.result.mesh.regions, 3), 0);
  EXPECT_GT(std::ranges::count(made.result.mesh.regions, 4), 0);
}

TEST(GmshHxt, FillsACubeWithAHoleAndKeepsItsTriangles) {
  if (!has("gmsh-hxt")) GTEST_SKIP() << "Gmsh is not installed";
  const InputPlc plc = shapes::with_repeated_vertices(shapes::cube_with_hole());
  const baselines::MesherRun made = run("gmsh-hxt", plc, unimproved(1));
  EXPECT_NEAR(volume(made.result.mesh), 26, 1e-9);
  EXPECT_EQ(made.result.mesh.faces.size(), 24u);
  EXPECT_EQ(made.result.counts.steiner_vertices, 0u);
  EXPECT_GT(made.result.counts.interior_vertices, 0u);
  EXPECT_GT(made.result.costs.mesh_seconds, 0);
}

TEST(GmshHxt, MakesMoreTetrahedraWhereTheEdgesAreShorter) {
  if (!has("gmsh-hxt")) GTEST_SKIP() << "Gmsh is not installed";
  const InputPlc plc = shapes::cube_with_grid(4);
  const auto count = [&](double edge_length) {
    return run("gmsh-hxt", plc, unimproved(edge_length)).result.counts.tetrahedra;
  };
  EXPECT_GT(count(0.1), 3 * count(0.2));
  EXPECT_GT(count(0), 100u);  // with the edge lengths of the surface
}

TEST(GmshHxt, ReadsCoordinatesBackThatNeedSeventeenDigits) {
  if (!has("gmsh-hxt")) GTEST_SKIP() << "Gmsh is not installed";
  InputPlc plc = shapes::cube();
  for (Point3& p : plc.vertices) p = (0.1 + 0.2) * p + Point3{0.1, 0.7, 1.0 / 3};
  EXPECT_EQ(run("gmsh-hxt", plc, bare).result.counts.steiner_vertices, 0u);
}

TEST(GmshHxt, KeepsRegionsAndMarkers) {
  if (!has("gmsh-hxt")) GTEST_SKIP() << "Gmsh is not installed";
  InputPlc plc = shapes::cube_with_hole();
  plc.inside = InputPlc::Inside::seeds;
  plc.triangle_markers.assign(12, 7);
  plc.triangle_markers.resize(24, 8);
  plc.regions = {{{0.5, 0.5, 0.5}, 3, 0}, {{1.5, 1.5, 1.5}, 4, 0}};
  const baselines::MesherRun made = run("gmsh-hxt", plc, unimproved(1));
  EXPECT_NEAR(volume(made.result.mesh), 27, 1e-9);
  EXPECT_GT(std::ranges::count(made.result.mesh.regions, 3), 0);
  EXPECT_GT(std::ranges::count(made.result.mesh.regions, 4), 0);
  EXPECT_EQ(std::ranges::count(made.result.mesh.face_markers, 7), 12);
  EXPECT_EQ(std::ranges::count(made.result.mesh.face_markers, 8), 12);
}

TEST(GmshHxt, OptimizesUnlessImprovementIsOff) {
  if (!has("gmsh-hxt")) GTEST_SKIP() << "Gmsh is not installed";
  MeshOptions options = {.edge_length = 0.25};
  options.improve.improvement = Improvement::all;
  EXPECT_EQ(setting(run("gmsh-hxt", shapes::cube_with_grid(4), options), "Mesh.Optimize"), "1");
  options.improve.improvement = Improvement::none;
  EXPECT_EQ(setting(run("gmsh-hxt", shapes::cube_with_grid(4), options), "Mesh.Optimize"), "0");
}

TEST(GmshHxt, RefusesFacetsInsideAVolume) {
  if (!has("gmsh-hxt")) GTEST_SKIP() << "Gmsh is not installed";
  InputPlc plc = shapes::cube();
  plc.inside = InputPlc::Inside::seeds;
  plc.vertices.insert(plc.vertices.end(), {{0.3, 0.3, 0.5}, {0.7, 0.3, 0.5}, {0.3, 0.7, 0.5}});
  plc.triangles.push_back({8, 9, 10});
  EXPECT_THROW(run("gmsh-hxt", plc, unimproved()), MeshError);
}

}  // namespace
}  // namespace ccdt
