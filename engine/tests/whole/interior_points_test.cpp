#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <set>
#include <utility>

#include "engine/delaunay/delaunay.h"
#include "engine/front/advance_front.h"
#include "engine/front/find_delaunay_faces.h"
#include "engine/geometry/balls.h"
#include "engine/geometry/predicates.h"
#include "engine/lattice/clear_sites.h"
#include "engine/lattice/place_lattice_points.h"
#include "engine/mesher.h"
#include "engine/plc/build_plc.h"
#include "engine/protection/make_room.h"
#include "engine/protection/protect_edges.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tests/whole/exhaustive_tetrahedralizations.h"
#include "models/solids.h"

// The paper: "Insertion of interior points does not affect CDT existence". It does: an edge of the PLC that is a
// Delaunay edge need not have an empty diametral sphere, and then an interior point outside that sphere can still be in
// every empty sphere that shows the edge to be Delaunay. The examples are the smallest that a random search among
// points with small whole coordinates found.

namespace ccdt {
namespace {

using namespace mesh_test;
using test::Polyhedron;

/// A tetrahedron, and in it a segment from its first corner to vertex 4. Vertex 1 is in the diametral sphere of the
/// segment; still it is a Delaunay edge.
InputPlc tetrahedron_with_segment() {
  InputPlc plc;
  plc.inside = InputPlc::Inside::seeds;
  plc.vertices = {{0, 6, 6}, {1, 3, 2}, {2, 5, 1}, {6, 0, 2}, {3, 2, 2}};
  plc.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  plc.segments = {{0, 4}};
  return plc;
}
constexpr Point3 beside_segment{4, 2, 3};

/// A tetrahedron with a dent: vertex 4 is where its face 0 2 3 was pushed in. The dent's three edges are reflex.
InputPlc dented_tetrahedron() {
  InputPlc plc;
  plc.vertices = {{2, 7, 0}, {5, 2, 2}, {0, 0, 5}, {1, 5, 4}, {1, 4, 4}};
  plc.triangles = {{4, 0, 2}, {2, 0, 1}, {3, 0, 4}, {3, 1, 0}, {3, 4, 2}, {3, 2, 1}};
  return plc;
}
constexpr Point3 below_dent{1, 3, 3};

/// The same vertices and segment without the triangles, inside a large cube. Each face of the cube has a vertex in its
/// middle, so that the smallest spheres of its triangles do not reach the middle of the cube.
InputPlc segment_in_large_cube() {
  InputPlc plc = tetrahedron_with_segment();
  plc.triangles.clear();
  constexpr double half = 16;
  const Point3 center{3, 3, 3};
  const auto corner = static_cast<std::uint32_t>(plc.vertices.size());
  for (int i = 0; i < 8; ++i)
    plc.vertices.push_back(center + half * Point3{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  for (const auto& q : std::vector<std::array<std::uint32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    const auto middle = static_cast<std::uint32_t>(plc.vertices.size());
    plc.vertices.push_back(0.5 * (plc.vertices[corner + q[0]] + plc.vertices[corner + q[2]]));
    for (int i = 0; i < 4; ++i) plc.triangles.push_back({corner + q[i], corner + q[(i + 1) % 4], middle});
  }
  return plc;
}

/// An input with protected edges, and an interior point to insert.
struct Protected {
  plc::Plc plc;
  protection::ProtectedDelaunay surface;
  const delaunay::Delaunay& delaunay = surface.delaunay;
  std::uint64_t splits;
  Point3 point;

  Protected(const InputPlc& input, const Point3& interior)
      : plc(plc::build_plc(input, {0})), surface(protection::unprotected(plc, delaunay::build_delaunay(plc.vertices))) {
    splits = protect(Protection::midpoint);
    point = (1 / plc.grid.unit) * (interior - plc.grid.origin);
  }

  bool has_edge(std::uint32_t a, std::uint32_t b) const { return delaunay::has_edge(delaunay, a, b); }
  /// \return  how many Steiner vertices it takes
  std::uint64_t protect(Protection strategy) {
    const std::size_t before = delaunay.vertices.size();
    surface = protection::protect_edges(plc, std::move(surface), strategy);
    return delaunay.vertices.size() - before;
  }
  /// \param with_regard  insert the point only if all protected edges stay
  /// \return             how many points were inserted
  std::uint64_t insert(bool with_regard) {
    if (with_regard && make_room(std::vector{point}, Protection::shell).empty()) return 0;
    insert_points(surface.delaunay, std::vector{point});
    return 1;
  }
  /// \return  the points that remain
  std::vector<Point3> make_room(const std::vector<Point3>& points, Protection strategy) {
    std::vector<Point3> remaining;
    for (const std::uint32_t i : protection::make_room(points, plc, strategy, surface, protection::Avoided::nothing))
      remaining.push_back(points[i]);
    return remaining;
  }
  void expect_protected_after(const std::vector<Point3>& points) const {
    delaunay::Delaunay d = delaunay;
    insert_points(d, points);
    for (std::size_t s = 0; s < surface.chains.size(); ++s) {
      const auto chain = surface.chains[s];
      for (std::size_t k = 1; surface.must_be_chain[s] && k < chain.size(); ++k)
        ASSERT_TRUE(delaunay::has_edge(d, chain[k - 1].vertex, chain[k].vertex)) << points.size() << " points";
    }
  }
  front::FrontResult advance() const {
    const facets::FacetMesh facets = facets::triangulate_facets(plc, surface.chains, delaunay);
    return front::advance_front({plc, facets, front::find_delaunay_faces(facets.triangles, delaunay), delaunay});
  }
};

bool is_in_ball(const Ball& ball, const Point3& p) {
  return std::sqrt(squared_length(p - ball.center)) <= ball.radius;
}

Polyhedron polyhedron_of(const InputPlc& input, const std::vector<Point3>& interior = {}) {
  Polyhedron result{input.vertices, input.triangles, input.segments};
  result.vertices.insert(result.vertices.end(), interior.begin(), interior.end());
  return result;
}

TEST(ExhaustiveTetrahedralizations, FindBothOfFivePointsAndNoneOfSchoenhardtsPolyhedron) {
  Polyhedron bipyramid{{{0, 0, 0}, {9, 0, 1}, {1, 8, 0}, {3, 2, 5}, {4, 3, -6}}, {}, {}};
  bipyramid.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
  ASSERT_TRUE(is_generic(bipyramid));
  EXPECT_EQ(count_tetrahedralizations(bipyramid).all, 2u);
  EXPECT_EQ(count_tetrahedralizations(bipyramid).constrained_delaunay, 1u);
  Polyhedron schoenhardt = polyhedron_of(plc_test::schoenhardt());
  for (Point3& p : schoenhardt.vertices) p = {std::round(1000 * p.x), std::round(1003 * p.y), std::round(1005 * p.z)};
  schoenhardt.vertices[0].z += 7;
  schoenhardt.vertices[4].x += 3;
  ASSERT_TRUE(is_generic(schoenhardt));
  EXPECT_EQ(count_tetrahedralizations(schoenhardt).all, 0u);
}

TEST(InteriorPoints, OnePointOutsideTheDiametralSphereKnocksOutAProtectedEdge) {
  Protected p(tetrahedron_with_segment(), beside_segment);
  EXPECT_EQ(p.splits, 0u);  // it is a Delaunay edge as it is
  EXPECT_FALSE(is_in_ball(smallest_ball(p.plc.vertices[0], p.plc.vertices[4]), p.point));
  EXPECT_TRUE(p.has_edge(0, 4));
  EXPECT_EQ(p.insert(false), 1u);
  EXPECT_FALSE(p.has_edge(0, 4));
}

TEST(InteriorPoints, OnePointOutsideTheDiametralSphereEndsExistenceForASegment) {
  const InputPlc input = tetrahedron_with_segment();
  const auto before = count_tetrahedralizations(polyhedron_of(input));
  EXPECT_EQ(before.constrained_delaunay, 1u);
  const Polyhedron with_point = polyhedron_of(input, {beside_segment});
  ASSERT_TRUE(is_generic(with_point));
  const auto after = count_tetrahedralizations(with_point);
  EXPECT_GT(after.all, 0u);  // there are tetrahedralizations with the segment, but
  EXPECT_EQ(after.constrained_delaunay, 0u);
}

TEST(InteriorPoints, OnePointEndsExistenceForASolidOfFiveVertices) {
  const InputPlc input = dented_tetrahedron();
  EXPECT_EQ(count_tetrahedralizations(polyhedron_of(input)).constrained_delaunay, 1u);
  const Polyhedron with_point = polyhedron_of(input, {below_dent});
  ASSERT_TRUE(is_generic(with_point));
  const auto after = count_tetrahedralizations(with_point);
  EXPECT_GT(after.all, 0u);
  EXPECT_EQ(after.constrained_delaunay, 0u);
}

/// Does the front finish, and are its tetrahedra locally Delaunay where two of them meet?
bool finds_constrained_delaunay(const Protected& p) {
  front::FrontResult front;
  try {
    front = p.advance();
  } catch (const MeshError&) {
    return false;
  }
  for (const auto& s : front.tetrahedra)
    for (const auto& t : front.tetrahedra) {
      std::vector<std::uint32_t> others;
      std::ranges::copy_if(t, std::back_inserter(others), [&](auto v) { return std::ranges::find(s, v) == s.end(); });
      const auto at = [&](std::uint32_t v) { return p.delaunay.point(v); };
      if (others.size() == 1 && insphere(at(s[0]), at(s[1]), at(s[2]), at(s[3]), at(others[0])) > 0) return false;
    }
  return true;
}

TEST(InteriorPoints, TheFrontFindsNoConstrainedDelaunayTetrahedraWhereExistenceHasEnded) {
  Protected p(dented_tetrahedron(), below_dent);
  EXPECT_EQ(p.splits, 0u);
  EXPECT_FALSE(is_in_ball(smallest_ball(p.plc.vertices[0], p.plc.vertices[4]), p.point));
  EXPECT_TRUE(p.has_edge(0, 4));
  EXPECT_TRUE(finds_constrained_delaunay(p));
  EXPECT_EQ(p.insert(false), 1u);
  EXPECT_FALSE(p.has_edge(0, 4));
  EXPECT_FALSE(finds_constrained_delaunay(p));
}

TEST(InteriorPoints, ThePaperSphereRuleDoesNotSaveTheEdge) {
  Protected p(segment_in_large_cube(), beside_segment);
  EXPECT_EQ(p.splits, 0u);
  const facets::FacetMesh facets = facets::triangulate_facets(p.plc, p.surface.chains, p.delaunay);
  const auto& v = p.plc.vertices;
  for (const auto& [a, b, c] : facets.triangles)
    EXPECT_FALSE(is_in_ball(smallest_ball(lattice::TrianglePoints{v[a], v[b], v[c]}), p.point));
  for (const plc::Segment& s : p.plc.segments)
    EXPECT_FALSE(is_in_ball(smallest_ball(v[s.ends[0]], v[s.ends[1]]), p.point));
  EXPECT_TRUE(p.has_edge(0, 4));
  EXPECT_EQ(p.insert(false), 1u);
  EXPECT_FALSE(p.has_edge(0, 4));
}

TEST(InteriorPoints, ThatWouldDestroyAProtectedEdgeAreDroppedAndTheEdgeStays) {
  Protected all[] = {{tetrahedron_with_segment(), beside_segment},
                     {dented_tetrahedron(), below_dent},
                     {segment_in_large_cube(), beside_segment}};
  for (Protected& p : all) {
    EXPECT_EQ(p.insert(true), 0u);
    EXPECT_EQ(p.delaunay.vertices.size(), p.plc.vertices.size());
    EXPECT_TRUE(p.has_edge(0, 4));
    EXPECT_TRUE(finds_constrained_delaunay(p));
  }
}

TEST(InteriorPoints, ProtectionAfterInsertionBringsExistenceBack) {
  for (const Protection strategy : {Protection::midpoint, Protection::shell}) {
    Protected p(dented_tetrahedron(), below_dent);
    p.insert(false);
    EXPECT_GT(p.protect(strategy), 0u);
    EXPECT_TRUE(finds_constrained_delaunay(p));
  }
}

/// Points in the box of the vertices: half of them anywhere, the others on a coarse grid, where many are cospherical
/// and some are where a vertex is.
std::vector<Point3> random_points(const plc::Plc& plc, std::size_t count, std::mt19937& random) {
  const Box box = bounding_box(plc.vertices);
  const Point3 size = box.high - box.low;
  std::set<std::array<double, 3>> points;
  while (points.size() < count) {
    const double steps = points.size() < count / 2 ? 0x1p30 : 12;
    const auto at = [&](double low, double extent) {
      return std::round(low + extent * static_cast<double>(random() % static_cast<std::uint64_t>(steps + 1)) / steps);
    };
    points.insert({at(box.low.x, size.x), at(box.low.y, size.y), at(box.low.z, size.z)});
  }
  std::vector<Point3> result;
  for (const auto& [x, y, z] : points) result.push_back({x, y, z});
  std::ranges::shuffle(result, random);
  return result;
}

std::vector<InputPlc> inputs_with_protected_edges(std::mt19937& random) {
  return {cube_with_turnstile(),
          two_bars(),
          gridded_plate(5, 0.01),
          gridded_cube(4),
          cube_within_cube(),
          random_voxels(3, 2, random),
          in_perspective(random_voxels(3, 3, random), 3),
          roughened(models::make_solid("sphere", 0.5), 0.3, random)};
}

TEST(InteriorPoints, ThatRemainKeepAllProtectedEdges) {
  std::mt19937 random(8);
  std::size_t kept = 0, left_out = 0;
  const std::vector<InputPlc> inputs = inputs_with_protected_edges(random);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    SCOPED_TRACE("input " + std::to_string(i));
    for (const std::size_t count : {10, 100, 1000}) {
      Protected p(inputs[i], {});
      const std::vector<Point3> points = random_points(p.plc, count, random);
      const std::vector<Point3> remaining = p.make_room(points, Protection::shell);
      p.expect_protected_after(remaining);
      kept += remaining.size();
      left_out += points.size() - remaining.size();
    }
  }
  EXPECT_GT(kept, 1000u);
  EXPECT_GT(left_out, 1000u);
}

/// Lets each vertex name another of its cells, as if cells had been made in another order.
void name_other_cells(delaunay::Delaunay& d, std::mt19937& random) {
  delaunay::CellStar star(d);
  for (std::uint32_t v = 0; v < d.vertices.size(); ++v) {
    const auto cells = star.around(v);
    d.cell_at[v] = cells[random() % cells.size()];
  }
}

TEST(InteriorPoints, ThatRemainDoNotDependOnTheOrderOfCells) {
  std::mt19937 random(9);
  for (const InputPlc& input : inputs_with_protected_edges(random)) {
    const Protected p(input, {});
    for (const std::size_t count : {10, 30, 100, 300, 1000, 3000}) {
      const std::vector<Point3> points = random_points(p.plc, count, random);
      std::set<std::vector<std::uint32_t>> results;
      for (int repetition = 0; repetition < 5; ++repetition) {
        protection::ProtectedDelaunay surface = p.surface;
        name_other_cells(surface.delaunay, random);
        results.insert(protection::make_room(points, p.plc, Protection::shell, surface, protection::Avoided::nothing));
      }
      EXPECT_EQ(results.size(), 1u) << count << " points";
    }
  }
}

/// The points of a lattice around the protected edges.
std::vector<Point3> lattice_points(const Protected& p, lattice::Lattice kind) {
  const facets::FacetMesh facets = facets::triangulate_facets(p.plc, p.surface.chains, p.delaunay);
  std::vector<lattice::SurfaceTriangle> triangles;
  for (std::size_t i = 0; i < facets.triangles.size(); ++i) {
    const plc::Facet& facet = p.plc.facets[facets.facet[i]];
    triangles.push_back({facets.triangles[i], p.plc.regions[facet.above].inside, p.plc.regions[facet.below].inside});
  }
  const auto subsegments = p.surface.chains.pieces();
  std::vector<Point3> vertices;
  for (const delaunay::DelaunayVertex& v : p.delaunay.vertices) vertices.push_back(v.point);
  lattice::LatticeOptions options;
  options.kind = kind;
  options.clearance = 0;
  const Box box = bounding_box(vertices);
  options.edge_length = length(box.high - box.low) / 30;
  return place_lattice_points({vertices, triangles, subsegments}, options).points;
}

TEST(InteriorPoints, OfALatticeRemainWhetherSmallestSpheresAreSearchedOrNot) {
  std::mt19937 random(10);
  std::size_t kept = 0, left_out = 0;
  for (int repetition = 0; repetition < 5; ++repetition) {
    for (const InputPlc& input : inputs_with_protected_edges(random)) {
      const Protected p(input, {});
      for (const lattice::Lattice kind : {lattice::Lattice::fcc, lattice::Lattice::bcc, lattice::Lattice::sc}) {
        const std::vector<Point3> points = lattice_points(p, kind);
        protection::ProtectedDelaunay surface = p.surface, searched = p.surface;
        const auto remain = make_room(points, p.plc, Protection::shell, surface, protection::Avoided::smallest_spheres);
        ASSERT_EQ(remain, make_room(points, p.plc, Protection::shell, searched, protection::Avoided::nothing));
        ASSERT_EQ(surface.delaunay.vertices.size(), searched.delaunay.vertices.size());
        kept += remain.size();
        left_out += points.size() - remain.size();
      }
    }
  }
  EXPECT_GT(kept, 1000u);
  EXPECT_GT(left_out, 10u);
}

/// A segment with a vertex beside its middle, so that only large spheres through its ends do not contain the vertex.
InputPlc segment_with_vertex_beside_it() {
  InputPlc plc = seeded_cube();
  plc.vertices.insert(plc.vertices.end(), {{1, 1.5, 1.5}, {2, 1.5, 1.5}, {1.5, 1.6875, 1.5}});
  plc.segments = {{8, 9}};
  return plc;
}

/// The smallest sphere through the ends of the segment that does not contain the vertex. The center is on the other
/// side of the segment.
Ball smallest_empty_ball(const plc::Plc& plc) {
  const Point3 &a = plc.vertices[8], &b = plc.vertices[9], &beside = plc.vertices[10];
  const Point3 middle = 0.5 * (a + b), up = beside - middle;
  const double half = 0.5 * length(b - a), height = length(up);
  const double depth = (half * half - height * height) / (2 * height);
  return {middle - (depth / height) * up, std::sqrt(half * half + depth * depth)};
}

TEST(InteriorPoints, OneSplitOfAnEdgeSparesManyOfThem) {
  std::mt19937 random(3);
  for (const Protection strategy : {Protection::midpoint, Protection::shell}) {
    Protected p(segment_with_vertex_beside_it(), {});
    EXPECT_TRUE(p.has_edge(8, 9));
    const std::vector<Point3> points = random_points(p.plc, 1000, random);
    const Ball ball = smallest_empty_ball(p.plc);
    const auto without_split =
        static_cast<std::size_t>(std::ranges::count_if(points, [&](const Point3& q) { return !is_in_ball(ball, q); }));
    const std::vector<Point3> remaining = p.make_room(points, strategy);
    EXPECT_EQ(p.delaunay.vertices.size(), p.plc.vertices.size() + 1);
    EXPECT_GE(remaining.size(), without_split + 20);
    EXPECT_TRUE(p.has_edge(8, 11) && p.has_edge(11, 9));
    p.expect_protected_after(remaining);
  }
}

TEST(InteriorPoints, EdgesThatHarmFewOfThemAreNotSplit) {
  std::mt19937 random(4);
  Protected p(segment_with_vertex_beside_it(), {});
  const std::vector<Point3> points = random_points(p.plc, 100, random);
  const std::vector<Point3> remaining = p.make_room(points, Protection::shell);
  EXPECT_EQ(p.delaunay.vertices.size(), p.plc.vertices.size());
  EXPECT_LT(remaining.size(), points.size());
  p.expect_protected_after(remaining);
}

/// A unit cube whose upper side is a dome of n x n squares, each split into two triangles.
plc::InputPlc cube_with_dome(std::uint32_t n, double height) {
  plc::InputPlc plc;
  const auto top = [n](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / n - 0.5, y = static_cast<double>(j) / n - 0.5;
      plc.vertices.push_back({x, y, 0.5 - height * (x * x + y * y)});
    }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) append_fan(plc, {top(i, j), top(i + 1, j), top(i + 1, j + 1), top(i, j + 1)});
  const auto bottom = static_cast<std::uint32_t>(plc.vertices.size());
  for (const auto& [x, y] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    plc.vertices.push_back({x, y, -0.5});
  append_fan(plc, {bottom, bottom + 3, bottom + 2, bottom + 1});
  for (std::uint32_t side = 0; side < 4; ++side) {
    std::vector<std::uint32_t> polygon = {bottom + side, bottom + (side + 1) % 4};
    for (std::uint32_t i = n + 1; i-- > 0;)
      polygon.push_back(side == 0 ? top(i, 0) : side == 1 ? top(n, i) : side == 2 ? top(n - i, n) : top(0, n - i));
    append_fan(plc, polygon);
  }
  return plc;
}

TEST(InteriorPoints, FewAreComparedWithTheSpheresOfANearlyFlatSurface) {
  // The squares' diagonals have no empty sphere that floating point can find, and the cells around them have spheres
  // that reach far away from the cube.
  MeshOptions options;
  options.edge_length = 0.03;
  options.improve.improvement = Improvement::none;
  const MeshResult mesh = mesh_plc(cube_with_dome(20, 1e-6), options);
  EXPECT_GT(mesh.counts.interior_vertices, 500u);
  EXPECT_LT(mesh.costs[Stage::lattice].work.box_pairs, 100u);  // 2,394 with a ball around all these spheres
}

TEST(InteriorPoints, ThatWereDroppedAreCounted) {
  // Without the sphere rule and close to the surface, some of the lattice's points harm reflex edges.
  MeshOptions options;
  options.sphere_factor = 0;
  options.clearance = 0.01;
  options.edge_length = 0.3;
  options.improve.improvement = Improvement::none;
  const MeshResult mesh = mesh_plc(cube_with_turnstile(), options);
  EXPECT_GT(mesh.counts.dropped_interior_vertices, 0u);
  options.sphere_factor = 1;
  options.clearance = lattice::usual_clearance;
  EXPECT_EQ(mesh_plc(cube_with_turnstile(), options).counts.dropped_interior_vertices, 0u);
}

}  // namespace
}  // namespace ccdt
