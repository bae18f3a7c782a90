#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "engine/base/errors.h"
#include "engine/front/advance_front.h"
#include "engine/front/find_delaunay_faces.h"
#include "engine/plc/build_plc.h"
#include "engine/plc/gather_parts.h"
#include "engine/plc/strict_places.h"
#include "engine/retry/divide_facets.h"
#include "engine/retry/remedies.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"

// What is tried when a facet that is flat only within the tolerance is in the way of the front.

namespace ccdt {
namespace {

using namespace mesh_test;

const plc::FacetPart bottom_left = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {0, 0, 2}};

TEST(StrictPlaces, LowerTheToleranceOfTheTrianglesInThem) {
  const std::vector<Point3> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {5, 5, 0}, {6, 5, 0}, {5, 6, 0}};
  const std::vector<std::array<VertexId, 3>> triangles = {{VertexId(0), VertexId(1), VertexId(2)},   // there
                                                          {VertexId(0), VertexId(1), VertexId(3)},   // beside
                                                          {VertexId(4), VertexId(5), VertexId(6)}};  // far
  plc::Strictness strictness;
  EXPECT_EQ(plc::tolerances_of(vertices, triangles, strictness, 8), (std::vector<double>{8, 8, 8}));
  strictness.places = {{bottom_left, 0.25}};
  EXPECT_EQ(plc::tolerances_of(vertices, triangles, strictness, 0.25), (std::vector<double>{0.0625, 0.25, 0.25}));
  strictness.share = 0.5;
  EXPECT_EQ(plc::tolerances_of(vertices, triangles, strictness, 0.25), (std::vector<double>{0.0625, 0.125, 0.125}));
}

TEST(StrictPlaces, BecomeExactlyFlatAndThenTheRestToo) {
  plc::Strictness strictness;
  const std::vector<plc::FacetPart> parts = {bottom_left};
  EXPECT_TRUE(plc::tighten(parts, strictness));
  EXPECT_TRUE(plc::tighten(parts, strictness));
  ASSERT_EQ(strictness.places.size(), 2u);
  EXPECT_GT(strictness.places[0].share, 0);
  EXPECT_EQ(strictness.places[1].share, 0);
  EXPECT_EQ(strictness.share, 1);
  double before = strictness.share;
  while (plc::tighten(parts, strictness)) {
    EXPECT_LT(strictness.share, before);
    before = strictness.share;
  }
  EXPECT_EQ(strictness.share, 0);
  EXPECT_EQ(strictness.places.size(), 2u);
}

TEST(StrictPlaces, ThatAreNotKnownAreEverywhere) {
  plc::Strictness strictness;
  EXPECT_TRUE(plc::tighten({}, strictness));
  EXPECT_TRUE(strictness.places.empty());
  EXPECT_LT(strictness.share, 1);
}

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

TEST(Retry, MeshesRotatedBarsInSinglePrecision) {
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

/// A plate hardly thicker than the tolerance, up to where its front gets stuck.
class StuckPlate {
 public:
  explicit StuckPlate(std::mt19937& random) : input(rough_plate(1e-5, random)) {
    plc = plc::build_plc(input, {.flatness = flatness});
    auto surface = protection::protect_edges(plc, protection::unprotected(plc, delaunay::build_delaunay(plc.vertices)),
                                             protection::Protection::shell);
    chains = surface.chains;
    facets = facets::triangulate_facets(plc, chains, surface.delaunay);
    for (const auto& v : surface.delaunay.vertices) points.push_back(v.point);
    const auto codes = front::find_delaunay_faces(facets.triangles, surface.delaunay);
    front = front::advance_front({plc, facets, codes, surface.delaunay}, {.locator = locate::LocatorKind::cavity});
  }
  retry::FailedAttempt attempt() const { return {plc, chains, facets, points, front.stuck->faces}; }

  static constexpr double flatness = 4e-6;
  InputPlc input;
  plc::Plc plc;
  protection::SegmentChains chains;
  facets::FacetMesh facets;
  std::vector<Point3> points;
  front::FrontResult front;
};

/// The rough plates that get stuck at known places.
template <class Check>
void for_stuck_plates(const Check& check) {
  std::mt19937 random(1);
  int checked = 0;
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    try {
      const StuckPlate plate(random);
      if (!plate.front.stuck || plate.front.stuck->faces.empty()) continue;
      check(plate);
      ++checked;
    } catch (const InputError&) {  // its facets cross
    }
  }
  EXPECT_GT(checked, 5);
}

TEST(Retry, SplitsSegmentsThenDividesFacetsAlongDelaunayTrianglesThenAlongThoseOfTheInput) {
  for_stuck_plates([](const StuckPlate& plate) {
    const std::size_t stuck_faces = plate.front.stuck->faces.size();
    for (const std::uint32_t face : plate.front.stuck->faces)
      EXPECT_FALSE(plate.plc.facets[plate.facets.facet[face]].exactly_flat);
    retry::Remedies remedies;
    ASSERT_TRUE(retry::add_remedy(plate.attempt(), remedies));
    EXPECT_EQ(remedies.splits.size(), 1u);
    EXPECT_TRUE(remedies.divided.empty());
    ASSERT_TRUE(retry::add_remedy(plate.attempt(), remedies));
    EXPECT_EQ(remedies.splits.size(), 1u);
    EXPECT_EQ(remedies.divided.size(), stuck_faces);
    EXPECT_FALSE(remedies.follow_input);
    ASSERT_TRUE(retry::add_remedy(plate.attempt(), remedies));
    EXPECT_TRUE(remedies.divided.empty());
    EXPECT_TRUE(remedies.follow_input);
    EXPECT_EQ(remedies.strictness.places.size(), stuck_faces);
  });
}

TEST(Retry, TakesBackSplitsThatCannotBeProtectedAndThenFollowsTheInput) {
  for_stuck_plates([](const StuckPlate& plate) {
    retry::Remedies remedies;
    ASSERT_TRUE(retry::add_remedy(plate.attempt(), remedies));
    ASSERT_TRUE(retry::replace_remedy(remedies));
    EXPECT_TRUE(remedies.splits.empty());
    ASSERT_TRUE(retry::add_remedy(plate.attempt(), remedies));
    EXPECT_TRUE(remedies.splits.empty());
    EXPECT_TRUE(remedies.divided.empty());
    EXPECT_EQ(remedies.strictness.places.size(), plate.front.stuck->faces.size());
    EXPECT_FALSE(retry::replace_remedy(remedies));
  });
}

TEST(Retry, KeepsSplitsIfOnlyTheFacetsDividedAfterThemCannotBeProtected) {
  for_stuck_plates([](const StuckPlate& plate) {
    retry::Remedies remedies;
    while (remedies.divided.empty()) ASSERT_TRUE(retry::add_remedy(plate.attempt(), remedies));
    ASSERT_TRUE(retry::replace_remedy(remedies));
    EXPECT_EQ(remedies.splits.size(), 1u);
    EXPECT_TRUE(remedies.follow_input);
  });
}

TEST(DividedFacets, OverlapWhereTheyShareMoreThanAnEdge) {
  const plc::FacetPart part = {{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}, {0, 0, 1}};
  const auto other = [](const std::array<Point3, 3>& corners, const Point3& normal) {
    return plc::FacetPart{corners, normal};
  };
  EXPECT_TRUE(retry::overlap(part, part));
  EXPECT_TRUE(retry::overlap(part, other({{{1, 1, 0.01}, {5, 1, 0}, {5, 5, 0}}}, {0, 0.01, 5})));
  EXPECT_FALSE(retry::overlap(part, other({{{4, 0, 0}, {4, 4, 0}, {0, 4, 0}}}, {0, 0, 1})));   // beside it
  EXPECT_FALSE(retry::overlap(part, other({{{1, 1, 0}, {1, 2, 0}, {2, 1, 0}}}, {0, 0, -1})));  // below it
}

using Triangles = std::vector<std::array<VertexId, 3>>;

Triangles sorted(Triangles triangles) {
  for (auto& t : triangles) std::ranges::sort(t);
  std::ranges::sort(triangles);
  return triangles;
}

TEST(DividedFacets, AreBoundedBySegmentsAndCoverThePlate) {
  std::size_t added_facets = 0;
  for_stuck_plates([&](const StuckPlate& plate) {
    retry::Remedies remedies;
    while (remedies.divided.empty()) ASSERT_TRUE(retry::add_remedy(plate.attempt(), remedies));
    const auto delaunay = delaunay::build_delaunay(plate.plc.vertices);
    plc::Plc divided = plate.plc;
    retry::divide_facets(delaunay, remedies.divided, plc::tolerance_of(divided, StuckPlate::flatness), divided);
    EXPECT_GE(divided.segments.size(), plate.plc.segments.size());
    ASSERT_GE(divided.facets.size(), plate.plc.facets.size());
    added_facets += divided.facets.size() - plate.plc.facets.size();

    std::set<std::array<VertexId, 2>> segments;
    for (const plc::Segment& s : divided.segments)
      EXPECT_TRUE(segments.insert({std::min(s.ends[0], s.ends[1]), std::max(s.ends[0], s.ends[1])}).second);
    for (const plc::Facet& facet : divided.facets) {
      EXPECT_TRUE(facet.triangle_count > 1 || facet.exactly_flat);
      std::map<std::array<VertexId, 2>, int> uses;
      for (const auto& t : divided.triangles_of(facet))
        for (std::size_t k = 0; k < 3; ++k) ++uses[{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])}];
      for (const auto& [edge, count] : uses) EXPECT_TRUE(count == 2 || segments.contains(edge));
    }
    const auto chains = protection::unprotected(plate.plc, {}).chains;
    EXPECT_EQ(sorted(divided.triangles), sorted(facets::triangulate_facets(plate.plc, chains, delaunay).triangles));
  });
  EXPECT_GE(added_facets, 20u);
}

TEST(DividedFacets, HoldBothHalvesOfAStripThinnerThanTheTolerance) {
  plc::Plc plc;
  plc.vertices = {{0, 0, 0}, {1000, 0, 0}, {1000, 1, 0}, {0, 1, 0}, {1000, 1000, 0}, {0, 1000, 0}, {500, 500, -700}};
  plc.regions = {{}, {.inside = true}};
  const auto id = [](std::uint32_t v) { return VertexId(v); };
  const Triangles triangles = {
      {id(0), id(1), id(2)}, {id(0), id(2), id(3)}, {id(3), id(2), id(4)}, {id(3), id(4), id(5)}};
  plc.add({.exactly_flat = false, .above = RegionId(0), .below = RegionId(1)}, triangles);
  constexpr std::array<std::uint32_t, 6> around = {0, 1, 2, 4, 5, 3};
  for (std::size_t i = 0; i < 6; ++i) plc.segments.push_back({{id(around[i]), id(around[(i + 1) % 6])}});
  const std::vector<plc::FacetPart> strip = {{{{{0, 0, 0}, {1000, 0, 0}, {1000, 1, 0}}}, {0, 0, 1}},
                                             {{{{0, 0, 0}, {1000, 1, 0}, {0, 1, 0}}}, {0, 0, 1}}};
  retry::divide_facets(delaunay::build_delaunay(plc.vertices), strip, 1, plc);
  EXPECT_EQ(plc.facets.size(), 2u);    // the strip and the rest
  EXPECT_EQ(plc.segments.size(), 7u);  // one between them, none between the halves
}

TEST(Retry, EndsWithTheSameMeshForAllStrategies) {
  std::mt19937 random(1);
  int meshed = 0;
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const InputPlc input = rough_plate(1e-5, random);
    MeshOptions options;
    options.lattice = Lattice::none;
    options.flatness = StuckPlate::flatness;
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
