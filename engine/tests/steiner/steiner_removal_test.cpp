#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "engine/steiner/loosen_star.h"
#include "engine/steiner/plan_vertex_removal.h"
#include "engine/tests/improve/improve_checks.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tets/shake_cells.h"

namespace ccdt {
namespace {

using namespace improve_test;
using namespace mesh_test;

constexpr tets::QualityGoal goal{tets::Objective::r, 1, 1};

/// A segment from 0 to 1 that vertex 2 splits, and tetrahedra in a ring of vertices, from 3 on, around it. Two facets
/// divide them into two regions.
Model split_segment_in_ring(std::uint32_t size) {
  Model model;
  model.points = {{0, 0, -1000}, {0, 0, 1000}, {0, 0, 100}};
  const auto at = [&](std::uint32_t i) { return 3 + i % size; };
  for (std::uint32_t i = 0; i < size; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / size;
    model.points.push_back({std::round(500 * std::cos(angle)), std::round(500 * std::sin(angle)), 0});
    for (const std::uint32_t end : {0u, 1u}) {
      model.cells.push_back({end, 2, at(i), at(i + 1)});
      model.regions.push_back(i < size / 2 ? 3 : 4);
    }
  }
  for (const std::uint32_t end : {0u, 1u}) {
    // Seen from one side, the faces on a facet turn the same way.
    for (const std::uint32_t i : {0u, size / 2})
      model.faces.push_back(end == 0 ? Triangle{0, 2, at(i)} : Triangle{2, 1, at(i)});
    model.facet_of_face.insert(model.facet_of_face.end(), {0, 1});
    model.segments.push_back({end, 2});
  }
  return model;
}

bool plan_removal(const tets::CellComplex& x, steiner::RemovalEffort effort, tets::Change& change) {
  steiner::RemovalScratch scratch;
  return steiner::plan_vertex_removal(x, 2, {0, 1}, effort, scratch, change);
}

TEST(VertexRemoval, MakesTheTwoPartsOfASegmentOneEdge) {
  for (std::uint32_t size = 4; size <= 12; size += 2) {
    SCOPED_TRACE(size);
    tets::CellComplex x = complex_of(split_segment_in_ring(size), goal);
    const auto volumes = invariants_of(x).sixfold_volumes;
    tets::Change change;
    ASSERT_TRUE(plan_removal(x, steiner::RemovalEffort::collapse, change));
    ASSERT_TRUE(x.all_positive(change));
    apply_change(x, change);
    expect_consistent(x);
    EXPECT_TRUE(invariants_of(x).sixfold_volumes == volumes);
    EXPECT_TRUE(x.is_removed(2));
    EXPECT_TRUE(x.is_segment(0, 1));
    EXPECT_FALSE(x.is_segment(0, 2) || x.is_segment(2, 1));
    EXPECT_EQ(cells_of(x).size(), size);
    for (const Tetrahedron& cell : cells_of(x)) EXPECT_TRUE(cell[0] == 0 && cell[1] == 1);
    EXPECT_TRUE(x.find_face(0, 1, 3) && x.find_face(0, 1, 3 + size / 2));
  }
}

TEST(VertexRemoval, MakesNoFaceOnTheHullOfTheCellsThatItReplaces) {
  // Beside the segment from 0 to 1, which vertex 2 splits, are a bent page with the vertices 3 and 4 and a flat one
  // with vertex 5. The cell 0 2 3 4 is on the bent page. If vertex 2 moved onto 0, a face on its hull would be on the
  // page.
  Model model;
  model.points = {{0, 0, -1000}, {0, 0, 1000}, {0, 0, 100}, {500, -1, -200}, {500, 0, 400}, {0, 800, 0}};
  model.cells = {{0, 2, 3, 4}, {0, 2, 4, 5}, {0, 3, 4, 5}, {1, 2, 4, 5}};
  model.regions.assign(model.cells.size(), 0);
  model.faces = {{0, 3, 2}, {2, 3, 4}, {2, 4, 1}, {0, 2, 5}, {2, 1, 5}};
  model.facet_of_face = {0, 0, 0, 1, 1};
  model.segments = {{0, 2}, {2, 1}};
  for (const steiner::RemovalEffort effort : {steiner::RemovalEffort::collapse, steiner::RemovalEffort::fill}) {
    tets::CellComplex x = complex_of(model, goal);
    tets::Change change;
    if (!plan_removal(x, effort, change)) continue;
    apply_change(x, change);
    expect_consistent(x);
    EXPECT_FALSE(x.find_face(0, 3, 4));
  }
  tets::CellComplex x = complex_of(model, goal);
  tets::Change change;
  EXPECT_TRUE(plan_removal(x, steiner::RemovalEffort::collapse, change));
}

TEST(VertexRemoval, LeavesNoGapsInTheMesh) {
  tets::CellComplex x = complex_of(split_segment_in_ring(6), goal);
  mesh::TetMesh mesh;
  mesh.face_markers = {10, 11, 12, 13};
  mesh.face_markers.resize(x.faces().size(), 14);
  mesh.edges = {{0, 1}};
  const std::size_t faces = x.faces().size();
  tets::Change change;
  ASSERT_TRUE(plan_removal(x, steiner::RemovalEffort::collapse, change));
  apply_change(x, change);
  EXPECT_EQ(std::move(x).take_mesh(mesh).size(), 8u);
  EXPECT_EQ(mesh.faces.size(), faces - 2);
  EXPECT_EQ(mesh.face_markers.size(), faces - 2);
  for (const auto& tetrahedron : mesh.tetrahedra)
    for (const std::uint32_t v : tetrahedron) EXPECT_LT(v, 8u);
  std::set<FaceKey> pages;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [a, b, c] = mesh.faces[f];
    if (mesh.face_markers[f] < 14) pages.insert(face_key(a, b, c));
  }
  EXPECT_EQ(pages, (std::set<FaceKey>{{0, 1, 2}, {0, 1, 5}}));
}

TEST(VertexRemoval, MakesTheTwoPartsOfASegmentOneEdgeWithoutFacets) {
  for (std::uint32_t size = 3; size <= 12; ++size) {
    SCOPED_TRACE(size);
    Model model = split_segment_in_ring(size);
    model.regions.clear();
    model.faces.clear();
    model.facet_of_face.clear();
    tets::CellComplex x = complex_of(model, goal);
    tets::Change change;
    ASSERT_TRUE(plan_removal(x, steiner::RemovalEffort::collapse, change));
    apply_change(x, change);
    expect_consistent(x);
    EXPECT_TRUE(x.is_segment(0, 1));
  }
}

TEST(VertexRemoval, SearchFindsTheSameTetrahedraWhereThereIsOnlyOneWay) {
  tets::CellComplex x = complex_of(split_segment_in_ring(4), goal);
  tets::Change change;
  ASSERT_TRUE(plan_removal(x, steiner::RemovalEffort::fill, change));
  apply_change(x, change);
  expect_consistent(x);
  EXPECT_TRUE(x.is_segment(0, 1));
}

/// The ring of six with a vertex at a random place in each cell.
Model split_segment_in_fog(std::mt19937& random) {
  Model model = split_segment_in_ring(6);
  const std::vector<Tetrahedron> cells = std::exchange(model.cells, {});
  const std::vector<int> regions = std::exchange(model.regions, {});
  for (std::size_t c = 0; c < cells.size(); ++c) {
    Point3 sum{};
    double total = 0;
    for (const std::uint32_t v : cells[c]) {
      const double weight = 1 + static_cast<double>(random() % 8);
      sum = sum + weight * model.points[v];
      total += weight;
    }
    const auto inside = static_cast<std::uint32_t>(model.points.size());
    model.points.push_back({std::round(sum.x / total), std::round(sum.y / total), std::round(sum.z / total)});
    for (std::size_t f = 0; f < 4; ++f) {
      Tetrahedron cell = cells[c];
      cell[f] = inside;
      model.cells.push_back(cell);
      model.regions.push_back(regions[c]);
    }
  }
  return model;
}

TEST(ShakeCells, MakesOnlyBetterCells) {
  std::mt19937 random(3);
  std::size_t count = 0;
  for (int i = 0; i < 20; ++i) {
    tets::CellComplex x = complex_of(split_segment_in_fog(random), goal);
    const auto before = invariants_of(x);
    const double least = worst_quality(x) / 2;
    std::vector<CellId> made;
    std::mt19937 shakes(2);
    tets::shake_cells(x, 2, 100, least, shakes, made);
    expect_consistent(x);
    EXPECT_TRUE(invariants_of(x) == before);
    EXPECT_GT(worst_quality(x), least);
    count += made.size();
  }
  EXPECT_GT(count, 0u);
}

TEST(Loosening, ChangesOnlyCellsAndFacesOfTheSameVerticesAndFacets) {
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    tets::CellComplex x = complex_of(split_segment_in_fog(random), goal);
    const auto before = invariants_of(x);
    const auto cells = cells_of(x);
    steiner::Loosening loosening;
    loosen_star(x, 2, 250, loosening);
    expect_consistent(x);
    EXPECT_TRUE(invariants_of(x) == before);
    EXPECT_NE(cells_of(x), cells);
    EXPECT_TRUE(x.is_segment(0, 2) && x.is_segment(2, 1));
    const double worst = worst_quality(x);
    tidy_star(x, 2, loosening);
    expect_consistent(x);
    EXPECT_TRUE(invariants_of(x) == before);
    EXPECT_GE(worst_quality(x), worst);
  }
}

TEST(Loosening, LeavesAVertexWithFewerEdges) {
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i) {
    tets::CellComplex x = complex_of(split_segment_in_fog(random), goal);
    const auto edges = [&] {
      int count = 0;
      for (std::uint32_t v = 0; v < x.vertex_count(); ++v) count += has_edge(x, 2, v);
      return count;
    };
    const int before = edges();
    steiner::Loosening loosening;
    loosen_star(x, 2, 250, loosening);
    EXPECT_LT(edges(), before);
  }
}

MeshOptions bare(SteinerRule rule) {
  MeshOptions options;
  options.lattice = Lattice::none;
  options.improve.steiner = rule;
  return options;
}

TEST(SteinerRemoval, KeepsWhatCannotBeTetrahedralizedWithout) {
  const InputPlc schoenhardt = plc_test::schoenhardt();
  const MeshResult kept = mesh_plc(schoenhardt, bare(SteinerRule::keep));
  const MeshResult removed = mesh_plc(schoenhardt, bare(SteinerRule::remove));
  EXPECT_EQ(kept.counts.steiner_vertices, 3u);
  EXPECT_GE(removed.counts.steiner_vertices, 1u);
  EXPECT_LT(removed.counts.steiner_vertices, 3u);
  expect_right(schoenhardt, removed.mesh);
}

TEST(SteinerRemoval, LeavesARightMeshWithTheCountsOfItsReport) {
  std::uint64_t kept_vertices = 0, removed_vertices = 0;
  for (const auto& [name, solid] : small_inputs())
    for (const InputPlc& input : {solid, rotated(oblique, solid)}) {
      SCOPED_TRACE(name);
      const MeshResult kept = mesh_plc(input, bare(SteinerRule::keep));
      expect_verified(input, kept.mesh);
      EXPECT_EQ(kept.counts.improve.removed_steiner_vertices, 0u);
      const MeshResult result = mesh_plc(input, bare(SteinerRule::remove));
      expect_right(input, result.mesh);
      const MeshCounts& counts = result.counts;
      EXPECT_EQ(counts.steiner_vertices + counts.improve.removed_steiner_vertices, kept.counts.steiner_vertices);
      EXPECT_EQ(counts.vertices + counts.improve.removed_steiner_vertices, kept.counts.vertices);
      EXPECT_EQ(result.mesh.constrained_delaunay, counts.improve.removed_steiner_vertices == 0);
      std::uint64_t splits = 0;
      for (const std::uint64_t n : counts.splits_by_level) splits += n;
      EXPECT_EQ(splits, counts.steiner_vertices);
      EXPECT_LE(counts.segments->restored, counts.segments->split);
      EXPECT_EQ(counts.segments->restored == counts.segments->split, counts.steiner_vertices == 0);
      kept_vertices += kept.counts.steiner_vertices;
      removed_vertices += counts.improve.removed_steiner_vertices;
    }
  EXPECT_GT(removed_vertices, kept_vertices / 2);
  EXPECT_LT(removed_vertices, kept_vertices);
}

TEST(SteinerRemoval, ComesBeforeImprovementWithALattice) {
  for (const auto& [name, input] : small_inputs()) {
    SCOPED_TRACE(name);
    MeshOptions options;
    options.edge_length = 0.5;
    const MeshResult result = mesh_plc(input, options);
    expect_right(input, result.mesh);
    options.improve.steiner = SteinerRule::keep;
    EXPECT_LE(result.counts.steiner_vertices, mesh_plc(input, options).counts.steiner_vertices);
  }
}

}  // namespace
}  // namespace ccdt
