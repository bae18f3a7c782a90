#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "engine/geometry/predicates.h"
#include "engine/improve/improve_mesh.h"
#include "engine/improve/insert_and_collapse.h"
#include "engine/tests/improve/improve_checks.h"
#include "engine/tets/shake_cells.h"

namespace ccdt {
namespace {

using namespace improve_test;

/// 1 / r alone, so that any difference of shape counts.
const tets::QualityGoal by_shape{tets::Objective::r, 1, 1};
const tets::QualityGoal by_angle{tets::Objective::dihedral, 0.5, std::sin(std::numbers::pi / 3)};

/// Tetrahedra around the edge from 0 to 1; the ring is 2, 3, ...
Model ring_of(std::uint32_t size, double height = 1000, double radius = 100) {
  Model model;
  model.points = {{0, 0, -height}, {0, 0, height}};
  for (std::uint32_t i = 0; i < size; ++i) {
    const double angle = 2 * std::numbers::pi * i / size;
    model.points.push_back({std::round(radius * std::cos(angle)), std::round(radius * std::sin(angle)), 0});
    model.cells.push_back({0, 1, 2 + i, 2 + (i + 1) % size});
  }
  return model;
}

/// Plans to remove an edge that the first cell has.
bool plan_removal(const tets::CellComplex& x, std::uint32_t a, std::uint32_t b, tets::Change& change) {
  return tets::plan_edge_removal(x, CellId(0), edge_of_cell(x, CellId(0), a, b), x.quality(CellId(0)), change);
}

/// Makes the change and expects a consistent result.
void apply_checked(tets::CellComplex& x, const tets::Change& change) {
  const Invariants before = invariants_of(x);
  ASSERT_TRUE(x.all_positive(change));
  apply_change(x, change);
  expect_consistent(x);
  EXPECT_TRUE(invariants_of(x) == before);
}

/// Two tetrahedra on a square whose diagonal, from 0 to 1, is too long; 2 and 3 are its other corners, 4 is above.
/// The square is facet 7, its sides are segments.
Model square_with_long_diagonal() {
  Model model;
  model.points = {{-300, 0, 0}, {300, 0, 0}, {0, -100, 0}, {0, 100, 0}, {0, 0, 150}};
  model.cells = {{0, 1, 2, 4}, {0, 1, 3, 4}};
  model.faces = {{0, 1, 2}, {1, 0, 3}};
  model.facet_of_face = {7, 7};
  model.segments = {{0, 2}, {2, 1}, {1, 3}, {3, 0}};
  return model;
}

/// The same with 5 below, and a region on either side.
Model square_between_regions() {
  Model model = square_with_long_diagonal();
  model.points.push_back({0, 0, -150});
  model.cells.insert(model.cells.end(), {{0, 1, 2, 5}, {0, 1, 3, 5}});
  model.regions = {1, 1, 2, 2};
  return model;
}

/// An octahedron of the vertices 0 to 5, whose inner vertex 6 is near vertex 0.
Model octahedron() {
  Model model;
  model.points = {{100, 0, 0}, {-100, 0, 0}, {0, 100, 0}, {0, -100, 0}, {0, 0, 100}, {0, 0, -100}, {80, 1, 2}};
  for (const std::uint32_t x : {0u, 1u})
    for (const std::uint32_t y : {2u, 3u})
      for (const std::uint32_t z : {4u, 5u}) model.cells.push_back({x, y, z, 6});
  model.first_interior = 6;
  return model;
}

TEST(Changes, ThreeTetrahedraAroundAnEdgeBecomeTwo) {
  tets::CellComplex x = complex_of(ring_of(3), by_shape);
  tets::Change change;
  ASSERT_TRUE(plan_removal(x, 0, 1, change));
  EXPECT_TRUE(change.faces.empty());
  apply_checked(x, change);
  EXPECT_EQ(cells_of(x), (std::set<Tetrahedron>{{0, 2, 3, 4}, {1, 2, 3, 4}}));
}

TEST(Changes, TwoFlatTetrahedraBecomeThreeAroundAnEdge) {
  Model model = ring_of(3, 300, 1000);
  model.cells = {{0, 2, 3, 4}, {1, 2, 3, 4}};
  tets::CellComplex x = complex_of(model, by_shape);
  tets::Change change;
  ASSERT_TRUE(tets::plan_face_removal(x, CellId(0), x.place(CellId(0), 0), x.quality(CellId(0)), change));
  apply_checked(x, change);
  EXPECT_EQ(cells_of(x), (std::set<Tetrahedron>{{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 3, 4}}));
}

TEST(Changes, FourTetrahedraAroundAnEdgeBecomeFourAroundTheShorterDiagonal) {
  Model model = ring_of(4);
  model.points[2].x = 150, model.points[4].x = -150;
  tets::CellComplex x = complex_of(model, by_shape);
  tets::Change change;
  ASSERT_TRUE(plan_removal(x, 0, 1, change));
  apply_checked(x, change);
  EXPECT_EQ(cells_of(x), (std::set<Tetrahedron>{{0, 2, 3, 5}, {0, 3, 4, 5}, {1, 2, 3, 5}, {1, 3, 4, 5}}));
}

TEST(Changes, RingsUpToTheLongestGiveWayToTwoTetrahedraForEachOfTheirTriangles) {
  for (std::uint32_t size = 3; size <= tets::longest_ring; ++size) {
    SCOPED_TRACE(size);
    tets::CellComplex x = complex_of(ring_of(size), by_shape);
    tets::Change change;
    ASSERT_TRUE(plan_removal(x, 0, 1, change));
    apply_checked(x, change);
    EXPECT_EQ(cells_of(x).size(), 2 * (size - 2));
    EXPECT_FALSE(has_edge(x, 0, 1));
  }
}

TEST(Changes, RingThatGivesWayToMoreTetrahedraCountsAsARemovedEdge) {
  tets::CellComplex x = complex_of(ring_of(5), by_shape);
  const improve::ImproveCounts counts = improve::improve_cells(x, {}, {.improvement = improve::Improvement::swap});
  EXPECT_EQ(cells_of(x).size(), 6u);
  EXPECT_EQ(counts.removed_edges, 1u);
  EXPECT_EQ(counts.removed_faces, 0u);
}

/// Two rings with a common triangle, and one far away. Both edges are planned to be removed at the same time.
TEST(Changes, ChangeBeyondAFaceOfACavityIsNoticed) {
  Model model = ring_of(3);
  // The second ring, 2, 3 and 6, is around the edge from 1 to 5; 1 2 3 is the common triangle.
  model.points.insert(model.points.end(), {{134, 232, -1000}, {150, 260, 0}});
  model.cells.insert(model.cells.end(), {{5, 1, 2, 3}, {5, 1, 3, 6}, {5, 1, 6, 2}});
  const auto offset = static_cast<std::uint32_t>(model.points.size());
  const Model far = ring_of(3);
  for (const Point3& p : far.points) model.points.push_back({p.x + 10000, p.y, p.z});
  for (const Tetrahedron& t : far.cells)
    model.cells.push_back({t[0] + offset, t[1] + offset, t[2] + offset, t[3] + offset});
  tets::CellComplex x = complex_of(model, by_shape);
  const Invariants before = invariants_of(x);
  tets::Change change, neighbor, distant;
  ASSERT_TRUE(plan_removal(x, 0, 1, change));
  ASSERT_TRUE(tets::plan_edge_removal(x, CellId(3), edge_of_cell(x, CellId(3), 1, 5), x.quality(CellId(3)), neighbor));
  distant.old_cells = {CellId(6), CellId(7), CellId(8)};
  tets::Cavity cavity, beside, apart;
  x.find_cavity(change, cavity);
  x.find_cavity(neighbor, beside);
  x.find_cavity(distant, apart);
  EXPECT_FALSE(x.has_changed_beyond(beside, x.change_count()));
  std::vector<CellId> places;
  const std::uint64_t since = x.change_count();
  x.announce(change, cavity, places);
  EXPECT_TRUE(x.has_changed_beyond(beside, since));
  EXPECT_FALSE(x.has_changed_beyond(beside, x.change_count()));
  EXPECT_FALSE(x.has_changed_beyond(apart, since));

  x.fill_cavity(change, places, cavity);
  tets::Cavity again;
  x.find_cavity(neighbor, again);
  const auto codes_of = [](const tets::Cavity& its) {
    std::set<std::uint32_t> codes;
    for (const tets::Cavity::Face& face : its.faces) codes.insert(face.code);
    return codes;
  };
  EXPECT_TRUE(codes_of(again) != codes_of(beside));
  x.announce(neighbor, again, places);
  x.fill_cavity(neighbor, places, again);
  expect_consistent(x);
  EXPECT_TRUE(invariants_of(x) == before);
}

TEST(CellSet, IsForgottenByEveryLaterSearch) {
  const tets::CellComplex x = complex_of(ring_of(3), by_shape);
  tets::CellSet cells;
  cells.start(x, CellId(1));
  for (int search = 0; search < 1 << 17; ++search) {
    cells.clear(x);
    ASSERT_FALSE(cells.contains(CellId(0)) || cells.contains(CellId(1))) << search;
  }
}

TEST(CellSet, GrowsToAStarAndHasItsHull) {
  const tets::CellComplex x = complex_of(octahedron(), by_shape);
  tets::CellSet star;
  star.gather_star(x, 6);
  EXPECT_EQ(star.cells().size(), 8u);
  std::size_t faces = 0;
  star.visit_hull(x, [&](std::uint32_t code) {
    ++faces;
    EXPECT_EQ(x.apex_of(code), 6u);
  });
  EXPECT_EQ(faces, 8u);
  star.gather_star(x, 0);
  EXPECT_EQ(star.cells().size(), 4u);
  star.start(x, x.cell_at(0));
  EXPECT_FALSE(star.grow(
      x, [](std::uint32_t) { return true; }, 0, 7));
  EXPECT_EQ(star.cells().size(), 7u);
}

TEST(Changes, LongerRingIsLeftAlone) {
  tets::CellComplex x = complex_of(ring_of(tets::longest_ring + 1), by_shape);
  // Not for lack of something better: of all triangles of the ring, none is smaller than one that cuts off a corner.
  EXPECT_GT(x.quality_of({2, 3, 4, 1}), x.quality(CellId(0)));
  tets::Change change;
  for (CellId c(0); c < x.cell_count(); c = CellId(c + 1))
    EXPECT_FALSE(tets::plan_edge_removal(x, c, edge_of_cell(x, c, 0, 1), x.quality(c), change));
}

TEST(Changes, RingThatIsAsGoodAsAnyIsLeftAlone) {
  tets::CellComplex x = complex_of(ring_of(5, 100, 170), by_shape);  // nearly regular tetrahedra
  tets::Change change;
  EXPECT_FALSE(plan_removal(x, 0, 1, change));
  EXPECT_EQ(expect_every_plan_is_sound(x).edge_removals, 0);
}

TEST(Changes, DiagonalOnAFlatBoundaryFacetIsExchanged) {
  tets::CellComplex x = complex_of(square_with_long_diagonal(), by_shape);
  tets::Change change;
  ASSERT_TRUE(plan_removal(x, 0, 1, change));
  EXPECT_EQ(change.faces.size(), 2u);
  apply_checked(x, change);
  EXPECT_EQ(cells_of(x), (std::set<Tetrahedron>{{0, 2, 3, 4}, {1, 2, 3, 4}}));
  EXPECT_TRUE(x.find_face(0, 2, 3));
  EXPECT_TRUE(x.find_face(1, 2, 3));
}

TEST(Changes, DiagonalOnAFacetBetweenRegionsIsExchangedOnBothSides) {
  tets::CellComplex x = complex_of(square_between_regions(), by_shape);
  tets::Change change;
  ASSERT_TRUE(plan_removal(x, 0, 1, change));
  apply_checked(x, change);
  EXPECT_EQ(cells_of(x), (std::set<Tetrahedron>{{0, 2, 3, 4}, {1, 2, 3, 4}, {0, 2, 3, 5}, {1, 2, 3, 5}}));
  for (CellId c(0); c < x.cell_count(); c = CellId(c + 1))
    EXPECT_EQ(x.region(c), std::ranges::count(x.cell(c).vertices, 4u) == 1 ? 1 : 2);
}

/// A dart-shaped facet, flat up to 3 units in 10,000. Corner 1 is reflex, between 2 and 3. Vertex 4 is just above the
/// plane. Removing the edge from 0 to 1 would give positive tetrahedra, but they would reach outside the dart.
Model nearly_flat_dart() {
  Model model;
  model.points = {{0, -10000, 0}, {0, -1000, -3}, {-10000, 0, 0}, {10000, 0, 0}, {0, 5000, 10}};
  model.cells = {{0, 1, 2, 4}, {0, 1, 3, 4}};
  model.faces = {{0, 1, 2}, {1, 0, 3}};
  model.facet_of_face = {7, 7};
  return model;
}

TEST(Changes, DiagonalOnANearlyFlatFacetIsNotExchangedWhereItsFacesWouldFoldOver) {
  const tets::CellComplex x = complex_of(nearly_flat_dart(), by_shape);
  ASSERT_LT(x.quality_of({2, 3, 4, 0}) * x.quality_of({2, 3, 4, 1}), 0);
  tets::Change change;
  for (CellId c(0); c < x.cell_count(); c = CellId(c + 1))
    EXPECT_FALSE(tets::plan_edge_removal(x, c, edge_of_cell(x, c, 0, 1), 0, change));
}

/// A pyramid on a parallelogram halfway between two axes. The base is flat up to a few units, and consists of four
/// faces around vertex 4 in its middle. Vertex 5 is the apex; there are more vertices inside.
Model pyramid_on_a_fan(std::mt19937& random) {
  std::uniform_int_distribution<int> any(-100000, 100000), few(-3, 3);
  const auto number = [&](auto& distance) { return static_cast<double>(distance(random)); };
  const auto point = [&](auto& distance) { return Point3{number(distance), number(distance), number(distance)}; };
  const auto in_plane = [&] {
    const double x = number(any);
    return Point3{x, -x, number(any)};
  };
  const Point3 u = in_plane(), v = in_plane();
  Model model;
  model.points = {u, v, -1 * u, -1 * v, point(few), point(any)};
  model.facet_of_face.assign(4, 7);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    model.cells.push_back({i, next, 4, 5});
    model.faces.push_back({i, next, 4});
    model.segments.push_back({i, next});
  }
  for (int i = 0; i < 4; ++i) {
    const Tetrahedron whole = model.cells[random() % model.cells.size()];
    const auto& p = model.points;
    const Point3 sum = p[whole[0]] + p[whole[1]] + p[whole[2]] + p[whole[3]];
    const auto inside = static_cast<std::uint32_t>(p.size());
    model.points.push_back({std::round(sum.x / 4), std::round(sum.y / 4), std::round(sum.z / 4)});
    std::erase(model.cells, whole);
    for (std::size_t corner = 0; corner < 4; ++corner) {
      model.cells.push_back(whole);
      model.cells.back()[corner] = inside;
    }
  }
  return model;
}

bool are_positive(const Model& model) {
  const auto& p = model.points;
  return std::ranges::all_of(model.cells,
                             [&](const Tetrahedron& t) { return orient3d(p[t[0]], p[t[1]], p[t[2]], p[t[3]]) > 0; });
}

// Needles next to the line between opposite corners may have normals in any direction. The axis closest to the normal
// may also be a different one for each face.
TEST(Changes, FacesOfANearlyFlatFacetAreSeenAlongOneAxis) {
  std::mt19937 random(1);
  int flipped = 0;
  for (int i = 0; i < 1000; ++i) {
    const Model model = pyramid_on_a_fan(random);
    if (!are_positive(model)) continue;
    tets::CellComplex x = complex_of(model, by_shape);
    std::vector<CellId> made;
    std::mt19937 shakes(2);
    tets::shake_cells(x, 4, 200, 0, shakes, made);
    flipped += !has_edge(x, 0, 4);
    expect_consistent(x);
  }
  EXPECT_GT(flipped, 10);
}

TEST(Changes, FlippedFacesStayFacesOfTheirFacetWithTheirOrientation) {
  tets::CellComplex x = complex_of(square_between_regions(), by_shape);
  tets::Change change;
  ASSERT_TRUE(plan_removal(x, 0, 1, change));
  apply_checked(x, change);
  mesh::TetMesh mesh;
  const std::size_t faces = x.faces().size();
  mesh.face_markers.resize(faces);
  std::move(x).take_mesh(mesh);
  ASSERT_EQ(mesh.faces.size(), faces);
  for (std::size_t f = 0; f < 2; ++f) {  // the first two are the square, which faced downwards
    const auto& [a, b, c] = mesh.faces[f];
    const auto& points = square_between_regions().points;
    EXPECT_LT(cross(points[b] - points[a], points[c] - points[a]).z, 0);
  }
}

TEST(Changes, EdgeOnASegmentIsNeverRemoved) {
  for (Model model : {ring_of(3), ring_of(4), ring_of(6), square_with_long_diagonal(), square_between_regions()}) {
    const tets::CellComplex free = complex_of(model, by_shape);
    tets::Change change;
    EXPECT_TRUE(plan_removal(free, 0, 1, change));
    model.segments.push_back({0, 1});
    const tets::CellComplex x = complex_of(model, by_shape);
    EXPECT_FALSE(plan_removal(x, 0, 1, change));
    expect_every_plan_is_sound(x);
  }
}

TEST(Changes, EdgeBetweenDifferentFacetsIsNeverRemoved) {
  for (Model model : {square_with_long_diagonal(), square_between_regions()}) {
    model.facet_of_face = {7, 8};
    const tets::CellComplex x = complex_of(model, by_shape);
    tets::Change change;
    EXPECT_FALSE(plan_removal(x, 0, 1, change));
    expect_every_plan_is_sound(x);
  }
}

TEST(Changes, DiagonalOfAQuadrilateralThatIsNotConvexStays) {
  Model model = square_with_long_diagonal();
  model.points[0] = {50, 0, 0};  // the other diagonal passes by
  model.points[2] = {0, -200, 0};
  model.points[3] = {0, 200, 0};
  const tets::CellComplex x = complex_of(model, by_shape);
  tets::Change change;
  EXPECT_FALSE(plan_removal(x, 0, 1, change));
}

TEST(Changes, WallIsNeverRemoved) {
  Model flat = ring_of(3, 300, 1000);
  flat.cells = {{0, 2, 3, 4}, {1, 2, 3, 4}};
  flat.faces = {{2, 3, 4}};
  flat.facet_of_face = {7};
  flat.regions = {1, 2};
  EXPECT_EQ(expect_every_plan_is_sound(complex_of(flat, by_shape)).face_removals, 0);
  Model ring = ring_of(5);  // with a wall that ends at its edge
  ring.faces = {{0, 1, 2}};
  ring.facet_of_face = {7};
  ring.segments = {{0, 1}, {1, 2}, {2, 0}};
  const tets::CellComplex x = complex_of(ring, by_shape);
  EXPECT_EQ(expect_every_plan_is_sound(x).edge_removals, 0);
}

TEST(Changes, TwoFacesAreRemovedTogetherWithTheEdgeBetweenThem) {
  Model model = ring_of(4, 100, 100);
  model.points[2].x = 150, model.points[4].x = -150;
  model.cells = {{0, 2, 3, 4}, {0, 2, 5, 4}, {1, 2, 3, 4}, {1, 2, 5, 4}};
  tets::CellComplex x = complex_of(model, by_shape);
  tets::Change change;
  ASSERT_TRUE(tets::plan_face_removal(x, CellId(0), x.place(CellId(0), 0), x.quality(CellId(0)), change));
  apply_checked(x, change);
  EXPECT_FALSE(has_edge(x, 2, 4));
  EXPECT_TRUE(has_edge(x, 0, 1));
}

TEST(Changes, DanglingSegmentBetweenTwoFacesStays) {
  Model model = ring_of(4, 100, 100);
  model.points[2].x = 150, model.points[4].x = -150;
  model.cells = {{0, 2, 3, 4}, {0, 2, 5, 4}, {1, 2, 3, 4}, {1, 2, 5, 4}};
  model.segments = {{2, 4}};
  const tets::CellComplex x = complex_of(model, by_shape);
  expect_every_plan_is_sound(x);
}

TEST(Changes, InteriorVertexIsCollapsed) {
  tets::CellComplex x = complex_of(octahedron(), by_shape);
  tets::Change change;
  improve::PlanScratch scratch;
  ASSERT_TRUE(improve::plan_collapse(x, CellId(0), x.quality(CellId(0)), scratch, change));
  apply_checked(x, change);
  EXPECT_TRUE(x.cell_at(6).is_none());
  mesh::TetMesh mesh;
  mesh.face_markers.resize(x.faces().size());
  EXPECT_EQ(std::move(x).take_mesh(mesh).size(), 6u);
  EXPECT_EQ(mesh.tetrahedra.size(), 4u);
}

TEST(Changes, CavityOfANewVertexSwallowsInteriorVertices) {
  const PlanCounts counts = expect_every_plan_is_sound(complex_of(octahedron(), by_angle));
  EXPECT_GT(counts.insertions, 0);
  EXPECT_TRUE(counts.vertices_gone.contains(6));
}

TEST(Changes, IsolatedVertexOfTheInputStays) {
  Model model = octahedron();
  model.first_interior = 7;
  for (const tets::QualityGoal& goal : {by_shape, by_angle}) {
    const PlanCounts counts = expect_every_plan_is_sound(complex_of(model, goal));
    EXPECT_EQ(counts.collapses, 0);
    EXPECT_TRUE(counts.vertices_gone.empty());
  }
}

TEST(Changes, CavityOfANewVertexKeepsDanglingSegments) {
  for (const std::uint32_t size : {3u, 4u, 5u, 6u, 7u}) {
    SCOPED_TRACE(size);
    Model model = ring_of(size, 400, 200);
    tets::CellComplex free = complex_of(model, by_angle);
    tets::Change change;
    improve::PlanScratch scratch;
    ASSERT_TRUE(improve::plan_insertion(free, CellId(0), free.quality(CellId(0)), scratch, change));
    apply_change(free, change);
    EXPECT_FALSE(has_edge(free, 0, 1));
    model.segments = {{0, 1}};
    expect_every_plan_is_sound(complex_of(model, by_angle));
  }
}

TEST(Changes, CavityOfANewVertexKeepsASegmentThatEndsInside) {
  Model model = octahedron();
  model.segments = {{1, 6}};
  model.first_interior = 7;
  for (const tets::QualityGoal& goal : {by_shape, by_angle})
    EXPECT_TRUE(expect_every_plan_is_sound(complex_of(model, goal)).vertices_gone.empty());
}

TEST(Changes, VertexIsInsertedIntoASliver) {
  Model model;  // the sliver 0 1 2 3, its long edges crossing, between the vertices 4 above and 5 below
  model.points = {{-100, 0, -2}, {100, 0, -2}, {0, -100, 2}, {0, 100, 2}, {0, 0, 140}, {0, 0, -140}};
  model.cells = {{0, 1, 2, 3}, {2, 3, 0, 4}, {2, 3, 1, 4}, {0, 1, 2, 5}, {0, 1, 3, 5}};
  tets::CellComplex x = complex_of(model, by_angle);
  EXPECT_LT(x.quality(CellId(0)), 0.1);
  tets::Change change;
  improve::PlanScratch scratch;
  ASSERT_TRUE(improve::plan_insertion(x, CellId(0), x.quality(CellId(0)), scratch, change));
  const Invariants before = invariants_of(x);
  apply_change(x, change);
  expect_consistent(x);
  EXPECT_EQ(x.vertex_count(), 7u);
  EXPECT_FALSE(x.cell_at(6).is_none());
  EXPECT_TRUE(invariants_of(x) == before);
  EXPECT_EQ(cells_of(x).size(), 8u);
  EXPECT_GT(worst_quality(x), 0.5);
}

}  // namespace
}  // namespace ccdt
