#include <gtest/gtest.h>

#include <random>
#include <set>

#include "engine/base/errors.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "models/solids.h"

// Opposite sides of a periodic mesh are equal, whatever the strategy; `verify` matches them by coordinates, while the
// engine works with places on its grid.

namespace ccdt {
namespace {

using namespace mesh_test;

/// A unit cube with 2 n^2 triangles on each side. All its squares have four corners on a circle.
InputPlc cube_of_squares(std::uint32_t n) {
  InputPlc cube;
  const auto vertex = [&](std::array<std::uint32_t, 3> at) {
    const Point3 p = (1.0 / n) * Point3{double(at[0]), double(at[1]), double(at[2])};
    const auto found = std::ranges::find(cube.vertices, p);
    if (found == cube.vertices.end()) return cube.vertices.push_back(p), std::uint32_t(cube.vertices.size() - 1);
    return std::uint32_t(found - cube.vertices.begin());
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const std::uint32_t side : {0u, n})
      for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
          const auto corner = [&](std::uint32_t a, std::uint32_t b) {
            std::array<std::uint32_t, 3> at = {};
            at[axis] = side, at[(axis + 1) % 3] = i + a, at[(axis + 2) % 3] = j + b;
            return vertex(at);
          };
          cube.triangles.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
          cube.triangles.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
        }
  return cube;
}

void add_octahedron(const Point3& center, double radius, InputPlc& plc) {
  const auto first = static_cast<std::uint32_t>(plc.vertices.size());
  for (const double r : {radius, -radius})
    for (const Point3 along : {Point3{r, 0, 0}, {0, r, 0}, {0, 0, r}}) plc.vertices.push_back(center + along);
  for (const std::uint32_t x : {0u, 3u})
    for (const std::uint32_t y : {1u, 4u})
      for (const std::uint32_t z : {2u, 5u}) plc.triangles.push_back({first + x, first + y, first + z});
}

/// A unit cube, through which a square duct goes along x. At both of its ends, two vertices are near a segment. Without
/// the walls of the duct, its ends are facets with another marker. Then the segments there are split because of these
/// vertices, and because of a small octahedron near one of them.
InputPlc cube_with_duct(bool has_walls = true) {
  InputPlc plc;
  for (const double x : {0.0, 1.0})
    for (const auto& [low, high] : {std::pair(0.0, 1.0), std::pair(0.3, 0.7)})
      for (const auto& [y, z] :
           {std::pair(low, low), std::pair(high, low), std::pair(high, high), std::pair(low, high)})
        plc.vertices.push_back({x, y, z});
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    plc.triangles.push_back({a, b, c});
    plc.triangles.push_back({a, c, d});
  };
  const auto add_fan = [&](const Point3& apex, const std::array<std::uint32_t, 4>& corners) {
    for (std::size_t i = 0; i < 4; ++i)
      plc.triangles.push_back({corners[i], corners[(i + 1) % 4], std::uint32_t(plc.vertices.size())});
    plc.vertices.push_back(apex);
  };
  for (const std::uint32_t end : {0u, 8u}) {
    const double x = end / 8;
    add_fan({x, 0.5, 0.375}, {end + 4, end + 5, end + 6, end + 7});
    add_fan({x, 0.5, 0.25}, {end, end + 1, end + 5, end + 4});
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    for (const std::uint32_t end : {0u, 8u})
      if (i > 0) add(end + i, end + j, end + 4 + j, end + 4 + i);
    for (const std::uint32_t ring : {0u, 4u})
      if (ring == 0 || has_walls) add(ring + i, ring + j, ring + 8 + j, ring + 8 + i);
  }
  if (!has_walls) {
    plc.triangle_markers.assign(plc.triangles.size(), 0);
    for (const std::size_t patch : {0, 8}) std::fill_n(plc.triangle_markers.begin() + patch, 4, 1);
  }
  add_octahedron({0.03125, 0.5625, has_walls ? 0.25 : 0.3}, 0.015625, plc);
  plc.triangle_markers.resize(plc.triangles.size(), 0);
  return plc;
}

verify::VerifyOptions with_equal_sides(Periodicity periodic) {
  verify::VerifyOptions options;
  options.periodic = periodic;
  return options;
}

void expect_periodic(const InputPlc& input, const MeshOptions& options) {
  SCOPED_TRACE(name_of(options.periodic));
  expect_right(input, mesh_plc(input, options).mesh, with_equal_sides(options.periodic));
}

TEST(Periodic, SidesAreEqualWithEveryStrategy) {
  for (const InputPlc& input : {cube_of_squares(1), cube_of_squares(4), cube_with_duct(), cube_with_duct(false)})
    for (const auto& periodic : names_of(Periodicity{}))
      for (const SurfaceRule surface : {SurfaceRule::keep, SurfaceRule::refine})
        for (const Lattice lattice : {Lattice::none, Lattice::fcc, Lattice::refinement}) {
          MeshOptions options;
          options.periodic = periodic.value;
          options.surface = surface;
          options.lattice = lattice;
          options.edge_length = 0.2;
          expect_periodic(input, options);
        }
}

TEST(Periodic, StrategiesAgree) {
  MeshOptions options;
  options.periodic = Periodicity::xyz;
  options.improve.improvement = Improvement::none;
  for (const InputPlc& input : {cube_of_squares(4), cube_with_duct()}) {
    const TetMesh first = mesh_plc(input, options).mesh;
    expect_verified(input, first);
    MeshOptions other = options;
    other.delaunay = DelaunayMethod::wrap;
    other.face_protection = false;
    other.threads = 1;
    expect_same_cells(first, mesh_plc(input, other).mesh);
  }
}

TEST(Periodic, SplitsOfOneSideAreRepeatedOnTheOther) {
  MeshOptions options;
  options.lattice = Lattice::none;
  options.improve.steiner = SteinerRule::keep;
  const InputPlc input = cube_with_duct(false);
  const MeshResult alone = mesh_plc(input, options);
  EXPECT_FALSE(verify::verify(input, alone.mesh, with_equal_sides(Periodicity::x)).ok());
  options.periodic = Periodicity::x;
  const MeshResult periodic = mesh_plc(input, options);
  expect_verified(input, periodic.mesh);
  expect_right(input, periodic.mesh, with_equal_sides(Periodicity::x));
  EXPECT_GT(periodic.counts.steiner_vertices, alone.counts.steiner_vertices);
}

TEST(Periodic, WithoutTheOptionSidesDiffer) {
  const InputPlc input = cube_with_duct();
  MeshOptions options;
  options.surface = SurfaceRule::refine;
  options.edge_length = 0.2;
  const TetMesh mesh = mesh_plc(input, options).mesh;
  expect_right(input, mesh);
  EXPECT_FALSE(verify::verify(input, mesh, with_equal_sides(Periodicity::x)).ok());
}

TEST(Periodic, RandomInclusions) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> where(0.2, 0.8);
  for (int i = 0; i < 10; ++i) {
    SCOPED_TRACE(i);
    InputPlc input = cube_of_squares(1 + i % 3);
    add_octahedron({where(random), where(random), where(random)}, 0.19, input);
    MeshOptions options;
    options.periodic = Periodicity::xyz;
    options.surface = i % 2 == 0 ? SurfaceRule::refine : SurfaceRule::keep;
    options.edge_length = 0.25;
    expect_periodic(input, options);
  }
}

void expect_refused(const InputPlc& input, Periodicity periodic) {
  MeshOptions options;
  options.periodic = periodic;
  try {
    mesh_plc(input, options);
    ADD_FAILURE() << "sides that differ were accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().points.size(), 1u);
    EXPECT_FALSE(error.remedy().empty());
  }
}

TEST(Periodic, SidesThatDifferAreRefused) {
  InputPlc moved_vertex = cube_of_squares(2);
  for (Point3& p : moved_vertex.vertices)
    if (p == Point3{1, 0.5, 0.5}) p.y += 0.125;
  expect_refused(moved_vertex, Periodicity::x);
  expect_periodic(moved_vertex, {.lattice = Lattice::none, .periodic = Periodicity::yz});

  InputPlc with_markers = cube_of_squares(2);  // the last two triangles are on the side of greatest z
  with_markers.triangle_markers.assign(with_markers.triangles.size(), 0);
  with_markers.triangle_markers.back() = 1;
  expect_refused(with_markers, Periodicity::z);
  expect_refused(with_markers, Periodicity::xyz);
  expect_periodic(with_markers, {.lattice = Lattice::none, .periodic = Periodicity::x});

  InputPlc with_roof = cube_of_squares(1);  // a pyramid has no second side
  with_roof.vertices.push_back({0.5, 0.5, 2});
  const auto apex = static_cast<std::uint32_t>(with_roof.vertices.size() - 1);
  const auto corner = [&](double x, double y) {
    return std::uint32_t(std::ranges::find(with_roof.vertices, Point3{x, y, 1}) - with_roof.vertices.begin());
  };
  with_roof.triangles.push_back({corner(0, 0), corner(1, 0), apex});
  with_roof.triangles.push_back({corner(1, 0), corner(1, 1), apex});
  with_roof.triangles.push_back({corner(1, 1), corner(0, 1), apex});
  with_roof.triangles.push_back({corner(0, 1), corner(0, 0), apex});
  expect_refused(with_roof, Periodicity::z);
}

TEST(Periodic, ANewSurfaceIsRefused) {
  MeshOptions options;
  options.periodic = Periodicity::x;
  options.surface = SurfaceRule::automatic;
  EXPECT_THROW(mesh_plc(cube_of_squares(1), options), InputError);
}

}  // namespace
}  // namespace ccdt
