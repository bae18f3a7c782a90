#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "bench/tests/verify_cases.h"
#include "bench/verify/verify.h"
#include "engine/mesher.h"

namespace ccdt {
namespace {

/// The cube [0, 3]^3: six polygons, or twelve triangles.
InputPlc big_cube(bool triangles) {
  InputPlc input = unit_cube();
  input.inside = InputPlc::Inside::seeds;
  for (Point3& p : input.vertices) p = 3 * p;
  if (!triangles) return input;
  for (const PolygonFacet& facet : input.polygon_facets) {
    const auto& q = facet.polygons[0];
    input.triangles.push_back({q[0], q[1], q[2]});
    input.triangles.push_back({q[0], q[2], q[3]});
  }
  input.polygon_facets.clear();
  return input;
}

void add_quadrilateral(InputPlc& input, const std::vector<Point3>& corners, bool triangles) {
  std::vector<std::uint32_t> q;
  for (const Point3& p : corners) {
    const auto found = std::find(input.vertices.begin(), input.vertices.end(), p);
    q.push_back(static_cast<std::uint32_t>(found - input.vertices.begin()));
    if (found == input.vertices.end()) input.vertices.push_back(p);
  }
  if (triangles) {
    input.triangles.push_back({q[0], q[1], q[2]});
    input.triangles.push_back({q[0], q[2], q[3]});
  } else {
    input.polygon_facets.push_back({{q}, {}, 0, static_cast<std::uint32_t>(input.facet_count())});
  }
}

/// Our mesh of the input, without the vertices of a lattice.
MeshedInput mesh_with_engine(const InputPlc& input) {
  MeshOptions options;
  options.lattice = Lattice::none;
  return {input, mesh_plc(input, options).mesh};
}

/// The grid's own mesh of the cube, with another input.
MeshedInput on_grid(const InputPlc& input) {
  return {input, make_grid_mesh({3, 3, 3}, everywhere, false, unmoved).mesh};
}

using Foot = std::array<Point3, 2>;

/// A sheet in the cube. Neighboring triangles are flat within the tolerance, and all of them together are not.
InputPlc cube_with_slightly_bent_sheet(std::mt19937& random) {
  constexpr int size = 8;
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const double bend = uniform(0.2e-7, 2e-7);
  InputPlc input = big_cube(true);
  const auto first = static_cast<std::uint32_t>(input.vertices.size());
  for (int i = 0; i <= size; ++i)
    for (int j = 0; j <= size; ++j) {
      const double x = 0.25 * i + uniform(-0.04, 0.04), y = 0.25 * j + uniform(-0.04, 0.04);
      input.vertices.push_back({0.5 + x, 0.5 + y, 1.5 + bend * x * x});
    }
  const auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(i * (size + 1) + j); };
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      const std::array<std::uint32_t, 4> q = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      const unsigned turn = random() % 2;
      input.triangles.push_back({q[turn], q[turn + 1], q[turn + 2]});
      input.triangles.push_back({q[turn], q[turn + 2], q[(turn + 3) % 4]});
    }
  return input;
}

TEST(VerifyTouching, SheetsThatAreFlatOnlyInPartsAreFoundAsListed) {
  std::mt19937 random(1);
  MeshOptions options;
  options.lattice = Lattice::none;
  options.improve.improvement = Improvement::all;
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const InputPlc input = cube_with_slightly_bent_sheet(random);
    const verify::Verification v = verify::verify(input, mesh_plc(input, options).mesh, {});
    EXPECT_TRUE(v.ok()) << all_lines(v);
  }
}

InputPlc cube_with_wall(const Foot& foot, const Point3& up, bool triangles) {
  InputPlc input = big_cube(triangles);
  add_quadrilateral(input, {foot[0], foot[1], foot[1] + up, foot[0] + up}, triangles);
  return input;
}

TEST(VerifyTouching, AWallMayStandInTheMiddleOfAFacet) {
  const std::vector<Foot> feet = {
      {{{1, 1, 0}, {2, 1, 0}}},     // from the input's diagonal
      {{{1, 1, 0}, {2, 2, 0}}},     // along a part of it
      {{{0, 0, 0}, {2, 1, 0}}},     // from a corner
      {{{.5, 2, 0}, {.75, 1, 0}}},  // on one side of the diagonal
  };
  for (const Foot& foot : feet)
    for (const bool triangles : {false, true})
      for (const Point3& up : {Point3{0, 0, 2}, Point3{0, 0.25, 2}}) {
        const InputPlc input = cube_with_wall(foot, up, triangles);
        expect_ok(mesh_with_engine(input));
        expect_failure({input, mesh_with_engine(big_cube(triangles)).mesh}, "input facets");
      }
}

/// A mesh of the cube with a line on its bottom, and the input without that line.
MeshedInput forget_line(const InputPlc& input, const Foot& foot) {
  InputPlc drawn = input;
  auto& polygons = drawn.polygon_facets[0].polygons;
  std::vector<std::uint32_t> line;
  for (const Point3& end : foot) {
    line.push_back(static_cast<std::uint32_t>(std::find(drawn.vertices.begin(), drawn.vertices.end(), end) -
                                              drawn.vertices.begin()));
    if (end.x == 0) polygons[0].insert(polygons[0].begin() + 1, line.back());
  }
  polygons.push_back(line);
  return {input, mesh_with_engine(drawn).mesh};
}

TEST(VerifyTouching, AFootMayCrossTheDiagonalsOfTheInput) {
  const std::vector<Foot> feet = {
      {{{1, 2, 0}, {2, 1, 0}}},
      {{{0, 1, 0}, {2, 1, 0}}},  // from an edge
      {{{0, 3, 0}, {3, 0, 0}}},  // from corner to corner
  };
  for (const Foot& foot : feet) {
    const Point3 up{0, 0, 0.5};
    const MeshedInput m = forget_line(cube_with_wall(foot, up, false), foot);
    expect_ok(m);
    expect_ok({cube_with_wall(foot, up, true), m.mesh});
  }
}

TEST(VerifyTouching, AFootThatTheMeshDoesNotHaveIsFound) {
  for (const bool triangles : {false, true}) {
    InputPlc input = big_cube(triangles);
    add_quadrilateral(input, {{1, 1, 0}, {2, 1, 0}, {2, 1, 2}, {1, 1, 2}}, triangles);
    expect_ok(on_grid(input));
    input = big_cube(triangles);
    add_quadrilateral(input, {{1, 2, 0}, {2, 1, 0}, {2, 1, 2}, {1, 2, 2}}, triangles);  // the grid's other diagonal
    expect_failure(on_grid(input), "input facets");
    expect_failure(on_grid(input), "input segments");
  }
}

TEST(VerifyTouching, TwoWallsMayStandOnOneFoot) {
  for (const bool triangles : {false, true}) {
    InputPlc input = big_cube(triangles);
    add_quadrilateral(input, {{1, 1, 0}, {2, 1, 0}, {2, 1, 1}, {1, 1, 1}}, triangles);
    add_quadrilateral(input, {{1, 1, 0}, {2, 1, 0}, {2, 2, 1}, {1, 2, 1}}, triangles);
    expect_ok(on_grid(input));
    expect_ok(mesh_with_engine(input));
  }
}

TEST(VerifyTouching, AWallWhoseLinesAreNotDrawnDividesTheDomain) {
  for (const bool triangles : {false, true}) {
    InputPlc input = big_cube(triangles);
    add_quadrilateral(input, {{1, 0, 0}, {1, 3, 0}, {1, 3, 3}, {1, 0, 3}}, triangles);
    input.regions = {{{0.3, 0.4, 0.6}, 1, 0}, {{2.3, 0.4, 0.6}, 2, 0}};
    MeshedInput m = on_grid(input);
    m.mesh.regions.clear();
    for (const auto& tet : m.mesh.tetrahedra) {
      double x = 0;
      for (const std::uint32_t v : tet) x += m.mesh.vertices[v].x / 4;
      m.mesh.regions.push_back(x < 1 ? 1 : 2);
    }
    expect_ok(m);
    m.mesh.regions[7] = 3 - m.mesh.regions[7];
    expect_failure(m, "regions");
  }
}

/// A box on the bottom of the cube, without a bottom of its own.
InputPlc cube_with_bell(bool triangles) {
  InputPlc input = big_cube(triangles);
  const std::vector<Point3> ring = {{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  const Point3 up{0, 0, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    const Point3 a = ring[i], b = ring[(i + 1) % 4];
    add_quadrilateral(input, {a, b, b + up, a + up}, triangles);
  }
  add_quadrilateral(input, {ring[0] + up, ring[1] + up, ring[2] + up, ring[3] + up}, triangles);
  return input;
}

TEST(VerifyTouching, ABoxMayUseAPartOfAFacetAsItsBottom) {
  for (const bool triangles : {false, true}) {
    InputPlc input = cube_with_bell(triangles);
    input.regions = {{{0.3, 0.4, 0.6}, 1, 0}, {{1.3, 1.4, 0.6}, 2, 0}};
    MeshedInput m = mesh_with_engine(input);
    expect_ok(m);
    for (int& r : m.mesh.regions) r = 1;
    expect_failure(m, "regions");
    m = on_grid(input);
    expect_failure(m, "regions");
    input.regions.clear();
    expect_ok({input, m.mesh});

    input.holes = {{1.3, 1.4, 0.6}};
    expect_failure({input, m.mesh}, "holes");
    expect_failure({input, m.mesh}, "input facets");
    m = mesh_with_engine(input);
    expect_ok(m);
    EXPECT_NEAR(verify::verify(m.input, m.mesh).input_volume, 26, 1e-12);
  }
}

TEST(VerifyTouching, AVertexMayTouchAFacetOrAnEdge) {
  for (const Point3& tip : {Point3{1, 1, 0}, Point3{2, 1, 0}, Point3{1, 0, 0}, Point3{1, 0, 1}})
    for (const bool triangles : {false, true}) {
      InputPlc input = big_cube(triangles);
      const auto n = static_cast<std::uint32_t>(input.vertices.size());
      input.vertices.insert(input.vertices.end(), {tip, {1, 1, 1}, {2, 2, 2}});
      input.triangles.push_back({n, n + 1, n + 2});
      expect_ok(mesh_with_engine(input));
    }
}

TEST(VerifyTouching, AWallMayStandInACornerWhereOneOfItsFeetIsDrawn) {
  InputPlc input = big_cube(false);
  add_quadrilateral(input, {{1, 2, 1}, {1, 3, 1}, {1, 3, 3}, {1, 2, 3}}, false);
  for (const bool drawn : {false, true}) {
    if (drawn) input.polygon_facets[3].polygons.push_back({9, 10});
    expect_ok(mesh_with_engine(input));
  }
}

TEST(VerifyTouching, RoundingMayMoveAVertexOffATurnedFacet) {
  InputPlc input = big_cube(false);
  for (Point3& p : input.vertices)
    p = {(2 * p.x - 2 * p.y + p.z) / 9, (p.x + 2 * p.y + 2 * p.z) / 9, (2 * p.x + p.y - 2 * p.z) / 9};
  const MeshedInput cube = mesh_with_engine(input);
  for (const std::uint32_t corner : {1u, 2u, 4u}) {
    input.vertices.resize(8);
    input.vertices.push_back(0.8125 * input.vertices[corner]);
    expect_ok({input, cube.mesh});
    expect_ok(mesh_with_engine(input));
  }
}

TEST(VerifyTouching, AVertexOutsideBesideAFacetMayBeMissing) {
  MeshedInput m = cube_in_five();
  m.input.vertices.push_back({1.5, 0.5, 1});
  expect_ok(m);
}

TEST(VerifyTouching, TwoSheetsOutsideMayEachBeAboveTheOther) {
  InputPlc input = big_cube(false);
  for (const bool other : {false, true}) {
    const double near = other ? 3 : 0, far = 3 - near, back = other ? 1.2 : 0, front = other ? 0.2 : 1;
    const auto add = [&](const std::vector<Point3>& corners) { add_quadrilateral(input, corners, false); };
    add({{near, back, 5}, {near + 1, back, 5}, {near + 1, front, 5}, {near, front, 5}});
    add({{far, back, 8}, {far + 1, back, 8}, {far + 1, front, 8}, {far, front, 8}});
    add({{near, back, 5}, {near + 1, back, 5}, {far + 1, back, 8}, {far, back, 8}});
  }
  expect_ok(mesh_with_engine(input));
}

TEST(VerifyTouching, ALineDividesAFacetFromBorderToBorder) {
  for (const Foot& line : {Foot{{{3, 1, 0}, {0, 2, 0}}}, Foot{{{3, 0, 0}, {0, 2, 0}}}, Foot{{{3, 1, 0}, {1, 1, 0}}}}) {
    InputPlc input = big_cube(false);
    const InputPlc cube = input;
    auto& drawn = input.polygon_facets[0].polygons.emplace_back();
    for (const Point3& p : line) {
      const auto found = std::ranges::find(input.vertices, p);
      drawn.push_back(static_cast<std::uint32_t>(found - input.vertices.begin()));
      if (found == input.vertices.end()) input.vertices.push_back(p);
    }
    expect_ok(mesh_with_engine(input));
    expect_failure({input, mesh_with_engine(cube).mesh}, "input segments");
  }
}

TEST(VerifyTouching, AnEdgeMayDivideATriangleFromItsCornerToASingleVertex) {
  // The triangle is partly within the cube. The cube's edge from its corner crosses its border at a vertex that is a
  // corner of no facet.
  for (const bool triangles : {false, true}) {
    InputPlc input = big_cube(triangles);
    const auto corner =
        static_cast<std::uint32_t>(std::ranges::find(input.vertices, Point3{0, 3, 3}) - input.vertices.begin());
    const auto first = static_cast<std::uint32_t>(input.vertices.size());
    input.vertices.insert(input.vertices.end(), {{1.5, 3, 3}, {1.5, 12, 12}, {1.5, 0, 0}});
    input.triangles.push_back({corner, first + 1, first + 2});
    expect_ok(mesh_with_engine(input));
  }
}

TEST(VerifyTouching, AVertexThatIsOnTheBoundaryOnlyWithinTheToleranceMayBeMissing) {
  const MeshedInput cube = mesh_with_engine(big_cube(false));
  InputPlc input = big_cube(false);
  input.vertices.push_back({1, 1, 3});
  for (const double off : {-1e-8, -1e-13, 1e-13}) {
    input.vertices.back().z = 3 + off;
    expect_ok({input, cube.mesh});
  }
  input.vertices.back() = {1, 1, 3};
  expect_failure({input, cube.mesh}, "input vertices");
  input.vertices.back() = {1, 1, 2.999};
  expect_failure({input, cube.mesh}, "input vertices");
}

/// Two pyramids, base to base. The corners of the bases lie in two planes, so a base is flat only within the tolerance
/// and higher along one diagonal than along the other. The gap between the bases is smaller than that.
///
/// \param crossing  does the mesh of the lower pyramid divide its base along the other diagonal?
MeshedInput base_to_base(bool crossing) {
  const double high = 4e-9, gap = 2e-9;
  MeshedInput m;
  m.input.vertices = {{0, 0, 0},   {1, 0, high},       {1, 1, 0},   {0, 1, high},       {0.5, 0.5, -1},
                      {0, 0, gap}, {1, 0, high + gap}, {1, 1, gap}, {0, 1, high + gap}, {0.5, 0.5, 2}};
  m.input.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4},
                       {5, 7, 6}, {5, 8, 7}, {5, 6, 9}, {6, 7, 9}, {7, 8, 9}, {8, 5, 9}};
  m.mesh.vertices = m.input.vertices;
  m.mesh.tetrahedra = {{5, 6, 7, 9}, {5, 7, 8, 9}, {0, 2, 1, 4}, {0, 3, 2, 4}};
  if (crossing) m.mesh.tetrahedra[2] = {0, 3, 1, 4}, m.mesh.tetrahedra[3] = {1, 3, 2, 4};
  m.mesh.regions.assign(4, 0);
  return m;
}

TEST(Verify, SaysWhereAMeshOverlapsItselfWithinTheTolerance) {
  for (const bool crossing : {false, true}) {
    const MeshedInput m = base_to_base(crossing);
    expect_ok(m);
    const verify::Verification v = verify::verify(m.input, m.mesh, tetrahedra_alone);
    const verify::Check& check = check_named(v, "boundary without crossings");
    EXPECT_FALSE(check.required);
    EXPECT_EQ(check.failed > 0, crossing);
    EXPECT_EQ(check.examples.empty(), !crossing);
  }
}

}  // namespace
}  // namespace ccdt
