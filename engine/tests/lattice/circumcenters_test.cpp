#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/base/errors.h"
#include "engine/delaunay/delaunay.h"
#include "engine/geometry/closest_point.h"
#include "engine/lattice/clear_sites.h"
#include "engine/lattice/octree.h"
#include "engine/lattice/place_circumcenters.h"
#include "engine/lattice/target_sizes.h"
#include "engine/tests/lattice/lattice_shapes.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tests/shared/real_parts.h"
#include "engine/tests/shared/sanitized.h"
#include "models/solids.h"

namespace ccdt::test {
namespace {

using lattice::Lattice;
using lattice::LatticeOptions;

LatticeOptions refinement(double radius_edge, double edge_length = 0, double grading = 0.5) {
  LatticeOptions options{.kind = Lattice::refinement, .edge_length = edge_length, .grading = grading};
  options.radius_edge = radius_edge;
  return options;
}

std::vector<Point3> refine(const Shape& shape, const LatticeOptions& options) {
  return lattice::place_circumcenters(surface_of(shape), delaunay::build_delaunay(shape.vertices), options).points;
}

/// The circumcenter of a cell, by Cramer's rule in long double, and the measures by which a cell is judged.
struct Sphere {
  Point3 center, centroid;
  double radius, shortest_edge;
};

Sphere sphere_of(const std::array<Point3, 4>& p) {
  using Row = std::array<long double, 4>;
  std::array<Row, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point3 u = p[i + 1] - p[0];
    rows[i] = {u.x, u.y, u.z, 0};
    for (std::size_t k = 0; k < 3; ++k) rows[i][3] += rows[i][k] * rows[i][k] / 2;
  }
  const auto det = [&](std::size_t a, std::size_t b, std::size_t c) {
    return rows[0][a] * (rows[1][b] * rows[2][c] - rows[1][c] * rows[2][b]) -
           rows[0][b] * (rows[1][a] * rows[2][c] - rows[1][c] * rows[2][a]) +
           rows[0][c] * (rows[1][a] * rows[2][b] - rows[1][b] * rows[2][a]);
  };
  const long double volume = det(0, 1, 2);
  const Point3 to_center{static_cast<double>(det(3, 1, 2) / volume), static_cast<double>(det(0, 3, 2) / volume),
                         static_cast<double>(det(0, 1, 3) / volume)};
  double shortest = HUGE_VAL;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) shortest = std::min(shortest, length(p[i] - p[j]));
  return {p[0] + to_center, 0.25 * (p[0] + p[1] + p[2] + p[3]), length(to_center), shortest};
}

bool is_inside(const Shape& shape, const Point3& p) {
  return std::abs(winding_number(shape, p)) > 0.75;
}

/// Is p in the smallest sphere of a triangle, which may be a segment? Uses a formula other than the engine's.
bool is_in_ball(const Point3& a, const Point3& b, const Point3& c, const Point3& p, double factor) {
  const double la = squared_length(b - c), lb = squared_length(c - a), lc = squared_length(a - b);
  Point3 center;
  if (la >= lb + lc)
    center = 0.5 * (b + c);
  else if (lb >= lc + la)
    center = 0.5 * (c + a);
  else if (lc >= la + lb)
    center = 0.5 * (a + b);
  else {
    const double wa = la * (lb + lc - la), wb = lb * (lc + la - lb), wc = lc * (la + lb - lc), sum = wa + wb + wc;
    center = (wa / sum) * a + (wb / sum) * b + (wc / sum) * c;
  }
  const double radius = std::max({length(a - center), length(b - center), length(c - center)});
  return length(p - center) <= factor * radius;
}

bool is_near_surface(const Shape& shape, const Point3& p, double clearance, double factor) {
  const auto near = [&](const Point3& a, const Point3& b, const Point3& c) {
    return is_in_ball(a, b, c, p, factor) ||
           squared_distance(lattice::TrianglePoints{a, b, c}, p) <= clearance * clearance;
  };
  return std::ranges::any_of(shape.triangles,
                             [&](const auto& t) {
                               return near(shape.vertices[t.vertices[0]], shape.vertices[t.vertices[1]],
                                           shape.vertices[t.vertices[2]]);
                             }) ||
         std::ranges::any_of(shape.subsegments, [&](const auto& s) {
           return near(shape.vertices[s[0]], shape.vertices[s[1]], shape.vertices[s[1]]);
         });
}

/// Every cell is neither skinny nor large, or there is a reason.
///
/// \return  how many cells are within the bounds
std::size_t expect_all_refined(const Shape& shape, const LatticeOptions& options) {
  constexpr double more = 1 + 1e-6, closer = 1 + 1e-6;
  std::vector<Point3> points = shape.vertices;
  const std::vector<Point3> added = refine(shape, options);
  points.insert(points.end(), added.begin(), added.end());
  const delaunay::Delaunay d = delaunay::build_delaunay(points);
  const lattice::Octree tree = build_octree(
      surface_of(shape), lattice::target_sizes(surface_of(shape), options.edge_length, options.grading, options.wanted),
      options.kind);
  std::size_t good = 0;
  for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
    if (!d.is_finite(c)) continue;
    const auto& v = d.cells[c].vertices;
    const Sphere s = sphere_of({d.point(v[0]), d.point(v[1]), d.point(v[2]), d.point(v[3])});
    if (!strictly_contains(tree.bounds, s.center)) continue;
    const lattice::OctreeNode& leaf = tree.leaf_with(s.center);
    const double target = edge_length_of_cell(options.kind, tree.length(tree.side(leaf)));
    const bool is_skinny = s.radius > more * options.radius_edge * s.shortest_edge,
               is_large = s.radius > more * lattice::radius_per_edge * target;
    const bool is_bad = is_skinny || is_large;
    const bool has_reason =
        !is_bad || !is_inside(shape, s.center) ||
        is_near_surface(shape, s.center, closer * options.clearance * target, more * options.sphere_factor) ||
        (!is_large && !is_inside(shape, s.centroid));
    EXPECT_TRUE(has_reason) << "radius over edge " << s.radius / s.shortest_edge << ", over target "
                            << s.radius / target;
    good += !is_bad;
  }
  return good;
}

int l_shape(int x, int y, int) {
  return x < 2 || y < 2 ? 1 : 0;
}
int box_in_box(int x, int y, int z) {
  return std::min({x, y, z}) > 0 && std::max({x, y, z}) < 4 ? 2 : 1;
}
int hollow(int x, int y, int z) {
  return std::min({x, y, z}) > 0 && std::max({x, y, z}) < 4 ? 0 : 1;
}

std::vector<Shape> shapes() {
  return {cube(4), cube(4, true), sphere(2), cubes(4, l_shape, true), cubes(5, box_in_box), cubes(5, hollow, true)};
}

TEST(Circumcenters, LeaveNoBadCellWhoseCircumcenterIsFarEnoughFromTheSurface) {
  std::size_t good = 0;
  for (const Shape& shape : shapes())
    for (const double bound : {1.0, 1.2, 1.5, 2.0})
      for (const double grading : {0.0, 0.5}) {
        SCOPED_TRACE(bound);
        good += expect_all_refined(shape, refinement(bound, 0.6 * shape.unit, grading));
      }
  EXPECT_GT(good, 10000u);
}

TEST(Circumcenters, AreIntegersInsideAndFarEnoughFromTheSurfaceAndFromEachOther) {
  std::size_t count = 0;
  for (const Shape& shape : shapes())
    for (const double clearance : {0.0, 0.55}) {
      LatticeOptions options = refinement(1.2, 0.6 * shape.unit, 0);
      options.clearance = clearance;
      const std::vector<Point3> points = refine(shape, options);
      count += points.size();
      const double least = 0.999 * std::min(lattice::radius_per_edge * options.edge_length, shape.unit / 2);
      for (std::size_t i = 0; i < points.size(); ++i) {
        for (const double c : as_array(points[i])) ASSERT_EQ(c, std::round(c));
        ASSERT_TRUE(is_inside(shape, points[i]));
        ASSERT_FALSE(is_near_surface(shape, points[i], clearance * options.edge_length * (1 - 1e-6), 1 - 1e-6));
        for (std::size_t j = 0; j < i; ++j) ASSERT_GT(length(points[i] - points[j]), least / 2);
      }
    }
  EXPECT_GT(count, 500u);
}

TEST(Circumcenters, DoNotDependOnTheOrderOfCells) {
  for (const Shape& shape : shapes()) {
    const LatticeOptions options = refinement(1.2, 0.6 * shape.unit, 0.3);
    const delaunay::Delaunay inserted = delaunay::build_delaunay(shape.vertices);
    delaunay::Delaunay wrapped = delaunay::wrap_delaunay(inserted.vertices);
    ASSERT_NE(inserted.cells[1].vertices, wrapped.cells[1].vertices);
    EXPECT_EQ(lattice::place_circumcenters(surface_of(shape), inserted, options).points,
              lattice::place_circumcenters(surface_of(shape), wrapped, options).points);
  }
}

/// The points in a box around the middle.
std::size_t count_within(const std::vector<Point3>& points, double half_side) {
  return static_cast<std::size_t>(std::ranges::count_if(points, [&](const Point3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= half_side;
  }));
}

TEST(Circumcenters, AreMoreForAShorterTarget) {
  const Shape shape = cube(12);
  std::size_t last = 0;
  for (const double edge_length : {1.0, 0.98, 0.96, 0.9, 0.8, 0.7}) {
    const std::size_t now = refine(shape, refinement(2, edge_length * shape.unit, 0)).size();
    EXPECT_GT(now, last);
    last = now;
  }
}

TEST(Circumcenters, MakeAsManyTetrahedraAsALattice) {
  const Shape shape = cube(12);
  const double edge_length = 0.7 * shape.unit, half_side = 5 * shape.unit;
  const auto circumcenters = static_cast<double>(count_within(refine(shape, refinement(2, edge_length, 0)), half_side));
  const auto lattice = static_cast<double>(count_within(shape.place({Lattice::fcc, edge_length, 0}), half_side));
  // With 6.75 tetrahedra at each vertex instead of 6. Near the surface there are more.
  EXPECT_LT(6.75 * circumcenters, 0.95 * 6 * lattice);
  EXPECT_GT(6.75 * circumcenters, 0.85 * 6 * lattice);
}

TEST(Circumcenters, EndForAnyBound) {
  for (const double bound : {1.0, 0.7, 0.3, 0.0}) {
    SCOPED_TRACE(bound);
    for (const Shape& shape : {cube(3), cube_with_a_fine_corner()})
      EXPECT_LT(refine(shape, refinement(bound, shape.unit)).size(), 100000u);
  }
}

TEST(Circumcenters, AreNotTooMany) {
  const Shape shape = cube(6);
  EXPECT_THROW(refine(shape, refinement(2, 1e-4 * shape.unit)), LimitError);
}

TEST(Circumcenters, NeedASurface) {
  Shape points = cube(2);
  points.triangles.clear();
  EXPECT_TRUE(refine(points, refinement(2, points.unit)).empty());
}

/// A background whose target is small in the middle of a cube and large at its surface.
sizes::BackgroundSizes fine_middle(double unit, double coarse, double fine) {
  sizes::BackgroundSizes background;
  for (const double r : {5.0, 1.0})
    for (const Point3& axis : {Point3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
      for (const double sign : {-1.0, 1.0}) {
        background.vertices.push_back((sign * r * unit) * axis);
        background.sizes.push_back((r > 1 ? coarse : fine) * unit);
      }
  return background;
}

TEST(Circumcenters, FollowTheSizesOfABackground) {
  const Shape shape = cube(6);
  sizes::WantedSizes wanted{{}, fine_middle(shape.unit, 1, 0.2)};
  LatticeOptions options = refinement(1.5);
  options.wanted = &wanted;
  expect_all_refined(shape, options);
  const auto in_middle = [&] {
    return std::ranges::count_if(refine(shape, options), [&](const Point3& p) { return length(p) < 1.5 * shape.unit; });
  };
  const auto graded = in_middle();
  EXPECT_GT(graded, 100);
  // Within the octahedron, sizes are linear; beyond, they are those of the nearest vertex.
  wanted.background.tetrahedra = {{6, 8, 10, 7}, {6, 10, 9, 7}, {6, 9, 11, 7}, {6, 11, 8, 7}};
  expect_all_refined(shape, options);
  EXPECT_GT(in_middle(), graded);
  wanted.background.sizes.assign(wanted.background.sizes.size(), 0.9 * shape.unit);
  EXPECT_LT(5 * in_middle(), graded);
}

TEST(Circumcenters, FillInputsOfEveryKind) {
  std::uint64_t interior = 0;
  for (const auto& [name, plain] : mesh_test::small_inputs())
    for (const InputPlc& input : {plain, plc_test::rotated(mesh_test::oblique, plain)}) {
      SCOPED_TRACE(name);
      MeshOptions options;
      options.lattice = Lattice::refinement;
      options.edge_length = 0.35;
      options.sphere_factor = 0.2;
      options.radius_edge = 1.2;
      options.improve.improvement = Improvement::none;
      const MeshResult plainly = mesh_plc(input, options);
      mesh_test::expect_right(input, plainly.mesh);
      interior += plainly.counts.interior_vertices;
      options.improve.improvement = Improvement::all;
      mesh_test::expect_right(input, mesh_plc(input, options).mesh);
    }
  EXPECT_GT(interior, 1000u);
}

TEST(Circumcenters, EndInRealPartsForTheLeastBound) {
  if (!there_are_parts()) GTEST_SKIP() << "no parts here; CCDT_PARTS names their folder";
  for (const std::string name : {"turbine.off", "anchor.off", "handle.off"}) {
    if (is_sanitized && name != "anchor.off") continue;
    SCOPED_TRACE(name);
    const InputPlc input = io::read_plc(folder_of_parts() / name);
    MeshOptions options;
    options.lattice = Lattice::refinement;
    options.radius_edge = 1;
    options.improve.improvement = Improvement::none;
    mesh_test::expect_right(input, mesh_plc(input, options).mesh);
  }
}

}  // namespace
}  // namespace ccdt::test
