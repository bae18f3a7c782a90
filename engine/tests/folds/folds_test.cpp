#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "engine/base/errors.h"
#include "engine/facets/facet_mesh.h"
#include "engine/folds/divide_facets.h"
#include "engine/folds/find_contacts.h"
#include "engine/folds/protect_facets.h"
#include "engine/front/find_delaunay_faces.h"
#include "engine/geometry/contacts.h"
#include "engine/geometry/predicates.h"
#include "engine/plc/build_plc.h"
#include "engine/plc/gather_parts.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"

// The invariant that keeps the front from getting stuck at facets that are flat only within the tolerance.

namespace ccdt {
namespace {

using namespace mesh_test;

/// A long bar with a round edge. Every second edge along it has vertices of its own, so its sides are fans.
InputPlc rounded_bar() {
  std::vector<std::array<double, 2>> profile = {{0, 0}, {10, 0}};
  for (int i = 0; i <= 9; ++i) {
    const double angle = i * std::numbers::pi / 18;
    profile.push_back({7 + 3 * std::cos(angle), 7 + 3 * std::sin(angle)});
  }
  profile.push_back({0, 10});
  const auto corners = static_cast<std::uint32_t>(profile.size());
  constexpr double length = 400;
  constexpr std::uint32_t rows = 20;
  InputPlc bar;
  for (const double end : {0.0, length})
    for (const auto& [x, y] : profile) bar.vertices.push_back({x, y, end});
  std::vector<std::vector<std::uint32_t>> edges;
  for (std::uint32_t c = 0; c < corners; ++c) {
    edges.push_back({c});
    for (std::uint32_t i = 1; c % 2 == 1 && i < rows; ++i) {
      edges.back().push_back(static_cast<std::uint32_t>(bar.vertices.size()));
      bar.vertices.push_back({profile[c][0], profile[c][1], length * i / rows});
    }
    edges.back().push_back(c + corners);
  }
  for (std::uint32_t c = 0; c < corners; ++c) {
    const auto &one = edges[c], &other = edges[(c + 1) % corners];
    for (std::size_t i = 0; i + 1 < one.size(); ++i) bar.triangles.push_back({one[i], other[0], one[i + 1]});
    for (std::size_t i = 0; i + 1 < other.size(); ++i) bar.triangles.push_back({other[i], other[i + 1], one.back()});
  }
  for (std::uint32_t c = 1; c + 1 < corners; ++c) {
    bar.triangles.push_back({0, c + 1, c});
    bar.triangles.push_back({corners, corners + c, corners + c + 1});
  }
  return bar;
}

/// Far from the origin in single precision, so that no oblique facet is exactly flat.
InputPlc rounded_to_single(const InputPlc& input) {
  const auto single = [](double c) { return static_cast<double>(static_cast<float>(c)); };
  return mapped(input, [&](const Point3& p) { return Point3{single(p.x - 1000), single(p.y), single(p.z + 100)}; });
}

/// A protected surface and its faces.
struct Surface {
  Surface(const InputPlc& input, double flatness) : plc(plc::build_plc(input, {.flatness = flatness})) {
    nearly_flat = static_cast<std::size_t>(std::ranges::count(plc.facets, false, &plc::Facet::exactly_flat));
    folds::SurfaceProtector protector(plc, delaunay::build_delaunay(plc.vertices), {}, plc::tolerance_of(plc, flatness),
                                      protection::Protection::shell);
    protector.protect_folds();
    surface = protector.protect();
    faces = facets::triangulate_facets(plc, surface.chains, surface.delaunay);
  }
  const Point3& point(std::uint32_t v) const { return surface.delaunay.point(v); }
  bool is_inside(RegionId region) const { return plc.regions[region].inside; }

  plc::Plc plc;
  std::size_t nearly_flat = 0;  ///< facets of the input
  protection::ProtectedDelaunay surface;
  facets::FacetMesh faces;
};

/// Every edge between two faces must be Delaunay if the domain spans more than 180 degrees there.
void expect_reflex_edges_are_delaunay(const Surface& s) {
  std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>> faces_at;
  for (std::uint32_t i = 0; i < s.faces.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = s.faces.triangles[i][k], b = s.faces.triangles[i][(k + 1) % 3];
      faces_at[{std::min(a, b), std::max(a, b)}].push_back(i);
    }
  for (const auto& [edge, faces] : faces_at) {
    ASSERT_EQ(faces.size(), 2u);
    const auto& t = s.faces.triangles[faces[0]];
    for (const VertexId apex : s.faces.triangles[faces[1]]) {
      if (apex == edge[0] || apex == edge[1]) continue;
      const int turn = orient3d(s.point(t[0]), s.point(t[1]), s.point(t[2]), s.point(apex));
      const plc::Facet& facet = s.plc.facets[s.faces.facet[faces[0]]];
      if ((turn > 0 && s.is_inside(facet.below)) || (turn < 0 && s.is_inside(facet.above))) {
        EXPECT_TRUE(delaunay::has_edge(s.surface.delaunay, edge[0], edge[1]));
      }
    }
  }
}

/// Faces without a common vertex must be apart.
void expect_faces_are_apart(const Surface& s) {
  const auto corners = [&](std::size_t i) {
    const auto& [a, b, c] = s.faces.triangles[i];
    return std::array{s.point(a), s.point(b), s.point(c)};
  };
  for (std::size_t i = 0; i < s.faces.triangles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto &t = s.faces.triangles[i], &u = s.faces.triangles[j];
      const bool share = std::ranges::any_of(t, [&](VertexId v) { return std::ranges::find(u, v) != u.end(); });
      EXPECT_FALSE(!share && meet_triangles(corners(i), corners(j)));
    }
}

constexpr double rough_flatness = 4e-6;

/// Calls check(surface) for rough plates that are hardly thicker than the tolerance.
template <class Check>
void for_rough_plates(const Check& check) {
  std::mt19937 random(1);
  std::size_t nearly_flat = 0, divided = 0;
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    try {
      const Surface surface(rough_plate(1e-5, random), rough_flatness);
      nearly_flat += surface.nearly_flat;
      divided += surface.plc.facets.size();
      check(surface);
    } catch (const InputError&) {  // its facets cross
    }
  }
  EXPECT_GT(nearly_flat, 20u);
  EXPECT_GT(divided, nearly_flat);
}

TEST(Invariant, ReflexEdgesAreDelaunay) {
  for_rough_plates(expect_reflex_edges_are_delaunay);
  std::mt19937 random(1);
  for (int i = 0; i < 3; ++i)
    expect_reflex_edges_are_delaunay(
        Surface(rounded_to_single(rotated(random_rotation(random), rounded_bar())), usual_flatness));
}

TEST(Invariant, FacesDoNotMeetOtherFacets) {
  for_rough_plates(expect_faces_are_apart);
}

TEST(Invariant, ExactlyFlatFacetsStayAsTheyAre) {
  for (const auto& [name, input] : small_inputs()) {
    SCOPED_TRACE(name);
    const plc::Plc plc = plc::build_plc(input);
    if (!std::ranges::all_of(plc.facets, &plc::Facet::exactly_flat)) continue;
    const Surface surface(input, usual_flatness);
    EXPECT_EQ(surface.plc.triangles, plc.triangles);
    EXPECT_EQ(surface.plc.segments.size(), plc.segments.size());
  }
}

TEST(Invariant, MeshesRotatedBarsInSinglePrecision) {
  std::mt19937 random(1);
  for (int i = 0; i < 10; ++i) {
    SCOPED_TRACE(i);
    const InputPlc input = rounded_to_single(rotated(random_rotation(random), rounded_bar()));
    MeshOptions options;
    options.lattice = Lattice::none;
    const MeshResult result = mesh_plc(input, options);
    expect_verified(input, result.mesh);
    options.face_protection = false;
    options.locator = locate::LocatorKind::octree;
    expect_same_cells(result.mesh, mesh_plc(input, options).mesh);
  }
}

using Triangles = std::vector<std::array<VertexId, 3>>;

Triangles sorted_triangles(Triangles triangles) {
  for (auto& t : triangles) std::ranges::sort(t);
  std::ranges::sort(triangles);
  return triangles;
}

/// A plane strip of two needles above a square of two triangles, all in one nearly flat facet, and a vertex below.
plc::Plc strip_and_square() {
  const auto id = [](std::uint32_t v) { return VertexId(v); };
  plc::Plc plc;
  plc.vertices = {{0, 0, 0}, {1000, 0, 0}, {1000, 1, 0}, {0, 1, 0}, {1000, 1000, 0}, {0, 1000, 0}, {500, 500, -700}};
  plc.regions = {{}, {.inside = true}};
  const Triangles triangles = {
      {id(0), id(1), id(2)}, {id(0), id(2), id(3)}, {id(3), id(2), id(4)}, {id(3), id(4), id(5)}};
  plc.add({.exactly_flat = false, .above = RegionId(0), .below = RegionId(1)}, triangles);
  constexpr std::array<std::uint32_t, 6> around = {0, 1, 2, 4, 5, 3};
  for (std::size_t i = 0; i < 6; ++i) plc.segments.push_back({{id(around[i]), id(around[(i + 1) % 6])}});
  return plc;
}

TEST(FacetDivider, KeepsNeedlesTogetherThenSeparatesThemThenFollowsTheInput) {
  const plc::Plc plc = strip_and_square();
  const delaunay::Delaunay delaunay = delaunay::build_delaunay(plc.vertices);
  folds::FacetDivider divider(plc, delaunay, 1);
  const facets::FacetMesh strip = {{plc.triangles[0], plc.triangles[1]}, {FacetId(0), FacetId(0)}};
  const auto divide = [&] { divider.divide(strip, std::vector<std::uint32_t>{0, 1}, {{FacetId(0), true}}, delaunay); };
  EXPECT_EQ(divider.divided().facets.size(), 1u);
  divide();
  EXPECT_EQ(divider.divided().facets.size(), 2u);    // the strip and the rest
  EXPECT_EQ(divider.divided().segments.size(), 7u);  // one between them, none between the halves
  divide();
  EXPECT_EQ(divider.divided().facets.size(), 3u);
  EXPECT_EQ(divider.divided().segments.size(), 8u);
  EXPECT_TRUE(std::ranges::all_of(divider.origins(), &folds::FacetOrigin::moved));
  divide();
  EXPECT_EQ(divider.divided().facets.size(), 4u);
  EXPECT_EQ(sorted_triangles(divider.divided().triangles), sorted_triangles(plc.triangles));
  EXPECT_TRUE(std::ranges::none_of(divider.origins(), &folds::FacetOrigin::moved));
  EXPECT_THROW(divide(), MeshError);
}

TEST(FacetDivider, FollowsTheInputBesideSegmentsThatCannotBeProtected) {
  const plc::Plc plc = strip_and_square();
  const delaunay::Delaunay delaunay = delaunay::build_delaunay(plc.vertices);
  folds::FacetDivider divider(plc, delaunay, 1);
  EXPECT_FALSE(divider.give_way({VertexId(0), VertexId(1)}));  // nothing is divided
  const facets::FacetMesh strip = {{plc.triangles[0]}, {FacetId(0)}};
  divider.divide(strip, std::vector<std::uint32_t>{0}, {{FacetId(0), true}}, delaunay);
  EXPECT_TRUE(divider.give_way({VertexId(0), VertexId(1)}));
  EXPECT_EQ(sorted_triangles(divider.divided().triangles), sorted_triangles(plc.triangles));
  EXPECT_EQ(divider.divided().facets.size(), 4u);
  EXPECT_FALSE(divider.give_way({VertexId(0), VertexId(1)}));
}

TEST(FacetDivider, MakesSegmentsGrazeable) {
  const plc::Plc plc = strip_and_square();
  folds::FacetDivider divider(plc, delaunay::build_delaunay(plc.vertices), 1);
  EXPECT_FALSE(divider.divided().segments[2].grazeable);
  divider.make_grazeable(plc, std::vector<std::uint32_t>{2});
  EXPECT_TRUE(divider.divided().segments[2].grazeable);
  EXPECT_FALSE(divider.divided().segments[3].grazeable);
}

TEST(Contacts, AreOfMovedFacesWithOthersOfWhichOneIsMissing) {
  const auto id = [](std::uint32_t v) { return VertexId(v); };
  // The long triangle 0 1 2 is missing, because 3, 4 and 5, a triangle across it, are near its middle.
  const std::vector<Point3> points = {{-1000, 0, 0}, {1000, 0, 0},  {0, 600, 0}, {0, 50, -10},
                                      {20, 60, 10},  {-20, 60, 10}, {0, 0, 900}, {0, 0, -900}};
  const delaunay::Delaunay delaunay = delaunay::build_delaunay(points);
  const facets::FacetMesh faces = {{{id(0), id(1), id(2)}, {id(3), id(4), id(5)}}, {FacetId(0), FacetId(1)}};
  const auto contacts = [&](bool first_moved, bool second_moved, std::uint32_t second) {
    return folds::find_contacts(faces, delaunay, front::find_delaunay_faces(faces.triangles, delaunay),
                                {{FacetId(0), first_moved}, {FacetId(second), second_moved}});
  };
  using Faces = std::vector<std::uint32_t>;
  EXPECT_EQ(contacts(false, false, 1), Faces());
  EXPECT_EQ(contacts(true, false, 1), Faces({0}));
  EXPECT_EQ(contacts(false, true, 1), Faces({1}));
  EXPECT_EQ(contacts(true, true, 1), Faces({0, 1}));
  EXPECT_EQ(contacts(true, true, 0), Faces());  // of one facet
}

/// A cube of two parts, on both sides of a square that bends along a diagonal by less than the tolerance.
InputPlc cube_with_a_nearly_flat_diaphragm() {
  InputPlc cube;
  for (const double z : {0.0, 0.5, 1.0})
    for (const auto& [x, y] : {std::array{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
      cube.vertices.push_back({x, y, z});
  cube.vertices[6].z += 1e-9;
  for (const std::uint32_t level : {0u, 4u})
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t a = level + i, b = level + (i + 1) % 4;
      cube.triangles.push_back({a, b, b + 4}), cube.triangles.push_back({a, b + 4, a + 4});
    }
  for (const std::uint32_t level : {0u, 4u, 8u}) {
    cube.triangles.push_back({level, level + 1, level + 2});
    cube.triangles.push_back({level, level + 2, level + 3});
  }
  return cube;
}

TEST(Invariant, HoldsWithInteriorVerticesBesideAFold) {
  const InputPlc input = cube_with_a_nearly_flat_diaphragm();
  MeshOptions options;
  options.edge_length = 0.1;
  options.improve = {.improvement = Improvement::none, .steiner = SteinerRule::keep};
  options.sphere_factor = 0.1;  // many interior vertices are in the smallest spheres of the faces
  const MeshResult result = mesh_plc(input, options);
  EXPECT_GT(result.counts.interior_vertices, 300u);
  expect_verified(input, result.mesh);
  options.face_protection = false;
  options.locator = locate::LocatorKind::octree;
  expect_same_cells(result.mesh, mesh_plc(input, options).mesh);
}

/// The protector's answer for a fold that interior vertices have destroyed.
TEST(Invariant, DoesNotHoldWhereInteriorVerticesDestroyAFold) {
  plc::Plc plc = plc::build_plc(cube_with_a_nearly_flat_diaphragm());
  const delaunay::Delaunay vertices = delaunay::build_delaunay(plc.vertices);
  folds::SurfaceProtector protector(plc, vertices, {}, plc::tolerance_of(plc, usual_flatness),
                                    protection::Protection::shell);
  protector.protect_folds();
  const protection::ProtectedDelaunay surface = protector.protect();
  const std::size_t facets_before = plc.facets.size();
  const facets::FacetMesh faces = facets::triangulate_facets(plc, surface.chains, surface.delaunay);
  const auto holds = [&](const delaunay::Delaunay& d) {
    return protector.is_protected(d, surface.chains, faces, front::find_delaunay_faces(faces.triangles, d));
  };
  EXPECT_TRUE(holds(surface.delaunay));
  const Point3 middle = 0.5 * (plc.vertices[4] + plc.vertices[6]);
  delaunay::Delaunay with_points = surface.delaunay;
  const std::array points = {middle + Point3{0, 0, 0x1p48}, middle - Point3{0, 0, 0x1p48}};
  insert_points(with_points, points, {});
  EXPECT_FALSE(holds(with_points));
  EXPECT_EQ(plc.facets.size(), facets_before + 1);  // the halves of the diaphragm are facets of their own
}

TEST(Invariant, GivesTheSameMeshForAllStrategies) {
  std::mt19937 random(1);
  int meshed = 0;
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const InputPlc input = rough_plate(1e-5, random);
    MeshOptions options;
    options.lattice = Lattice::none;
    options.flatness = rough_flatness;
    options.improve.steiner = SteinerRule::keep;
    try {
      const MeshResult usual = mesh_plc(input, options);
      for (const auto locator : {locate::LocatorKind::grid, locate::LocatorKind::octree}) {
        options.locator = locator;
        options.face_protection = locator == locate::LocatorKind::grid;
        options.threads = 3;
        expect_same_cells(usual.mesh, mesh_plc(input, options).mesh);
      }
      ++meshed;
    } catch (const InputError&) {
    }
  }
  EXPECT_GT(meshed, 10);
}

}  // namespace
}  // namespace ccdt
