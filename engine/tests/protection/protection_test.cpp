#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "engine/base/errors.h"
#include "engine/base/simplex_map.h"
#include "engine/delaunay/delaunay.h"
#include "engine/plc/build_plc.h"
#include "engine/plc/warped_facets.h"
#include "engine/protection/protect_edges.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tests/shared/sanitized.h"
#include "engine/tests/shared/thin_plates.h"
#include "models/solids.h"

namespace ccdt {
namespace {

using namespace mesh_test;

MeshResult bare_mesh(const InputPlc& input, Protection protection = Protection::shell) {
  MeshOptions options;
  options.lattice = Lattice::none;
  options.protection = protection;
  options.improve.steiner = SteinerRule::keep;
  return mesh_plc(input, options);
}

double distance_to_segment(const Point3& p, const Point3& a, const Point3& b) {
  const Point3 along = b - a;
  const double t = std::clamp(dot(p - a, along) / squared_length(along), 0.0, 1.0);
  return std::sqrt(squared_length(p - (a + t * along)));
}

void expect_steiner_vertices_on_grazeable_segments(const InputPlc& input, const MeshResult& result) {
  const plc::Plc plc = plc::build_plc(input);
  for (std::size_t v = plc.vertices.size(); v < plc.vertices.size() + result.counts.steiner_vertices; ++v) {
    double nearest = 1e300;
    for (const plc::Segment& s : plc.segments)
      if (s.grazeable)
        nearest =
            std::min(nearest, distance_to_segment(result.mesh.vertices[v], plc.world[s.ends[0]], plc.world[s.ends[1]]));
    EXPECT_LT(nearest, 1e-8);
  }
}

/// Many reflex edges, some of them missing from the Delaunay tetrahedralization.
std::vector<InputPlc> inputs_with_reflex_edges() {
  std::mt19937 random(7);
  std::vector<InputPlc> inputs = {plc_test::schoenhardt(), cube_with_floating_segment(), cube_with_turnstile(),
                                  twisted_prism(6, 0.25), models::make_solid("bracket", 11)};
  for (int i = 0; i < 6; ++i) inputs.push_back(random_voxels(3, 2, random));
  for (int i = 0; i < 6; ++i) inputs.push_back(roughened(models::make_solid("sphere", 0.5), 0.2, random));
  return inputs;
}

TEST(Protection, ConvexEdgesAreNeverSplit) {
  const MeshResult bars = bare_mesh(two_bars());
  EXPECT_GT(bars.counts.undelaunay_faces, 0u);  // the long edges are indeed no Delaunay edges
  EXPECT_EQ(bars.counts.steiner_vertices, 0u);
  std::size_t steiner_vertices = 0;
  for (const Protection strategy : {Protection::shell, Protection::midpoint})
    for (const InputPlc& input : inputs_with_reflex_edges()) {
      const MeshResult result = bare_mesh(input, strategy);
      expect_steiner_vertices_on_grazeable_segments(input, result);
      steiner_vertices += result.counts.steiner_vertices;
    }
  EXPECT_GT(steiner_vertices, 50u);
}

TEST(Protection, ConvexPolyhedraNeedNoSteinerVertex) {
  std::mt19937 random(8);
  for (std::uint32_t i = 4; i < 40; ++i) EXPECT_EQ(bare_mesh(random_convex(i, random)).counts.steiner_vertices, 0u);
}

TEST(Protection, SchoenhardtPolyhedronNeedsThreeSteinerVerticesAtMidpoints) {
  const MeshResult result = bare_mesh(plc_test::schoenhardt(), Protection::midpoint);
  EXPECT_EQ(result.counts.steiner_vertices, 3u);  // one on each reflex edge
}

TEST(Protection, SchoenhardtPolyhedronNeedsAtMostFourSteinerVerticesOnShells) {
  const MeshResult result = bare_mesh(plc_test::schoenhardt(), Protection::shell);
  EXPECT_GE(result.counts.steiner_vertices, 1u);
  EXPECT_LE(result.counts.steiner_vertices, 4u);
}

/// The pieces of the segments that are edges of no cell, found without walks.
std::size_t count_missing(const plc::Plc& plc, const protection::SegmentChains& chains, const delaunay::Delaunay& d) {
  std::set<std::uint64_t> edges;
  for (std::uint32_t c = 0; c < d.cells.size(); ++c)
    for (int i = 1; i < 4 && d.is_finite(c); ++i)
      for (int j = 0; j < i; ++j) edges.insert(edge_key(d.cells[c].vertices[i], d.cells[c].vertices[j]));
  std::size_t missing = 0;
  for (std::size_t s = 0; s < plc.segments.size(); ++s)
    for (std::size_t i = 0; i + 1 < chains[s].size(); ++i)
      missing += !edges.contains(edge_key(chains[s][i].vertex, chains[s][i + 1].vertex));
  return missing;
}

TEST(Protection, EverySegmentIsADelaunayEdgeOrSplitOrLeftToTheFront) {
  std::vector<InputPlc> inputs = inputs_with_reflex_edges();
  inputs.push_back(two_bars());
  front::SegmentCounts sum;
  for (const InputPlc& input : inputs) {
    const front::SegmentCounts counts = bare_mesh(input).counts.segments.value();
    const plc::Plc plc = plc::build_plc(input);
    const auto [delaunay, chains, grazeable] = protection::protect_edges(
        plc, protection::unprotected(plc, delaunay::build_delaunay(plc.vertices)), Protection::shell);
    EXPECT_EQ(counts.all, plc.segments.size());
    EXPECT_EQ(counts.all, counts.delaunay + counts.split + counts.front);
    EXPECT_EQ(counts.grazeable, std::ranges::count(grazeable, true));
    EXPECT_EQ(counts.pieces - counts.split, delaunay.vertices.size() - plc.vertices.size());
    EXPECT_EQ(counts.front, count_missing(plc, chains, delaunay));
    sum.split += counts.split, sum.front += counts.front;
  }
  EXPECT_GT(sum.split, 30u);
  EXPECT_GT(sum.front, 3u);
}

/// A thin plate with a fan of long triangles inside, whose corners are nearly collinear. Their edges are not quite
/// parallel, so that the feet of the vertices of one edge on another move with each split.
InputPlc plate_with_narrow_fan() {
  InputPlc plate;
  plate.name = "plate with a narrow fan";
  plate.inside = InputPlc::Inside::seeds;
  plate.vertices = {{0, 0, 0},
                    {0, 0.125, 0},
                    {0, 0.125, 16},
                    {0, 0, 16},
                    {0.25, 0, 0},
                    {0.25, 0.125, 0},
                    {0.25, 0.125, 16},
                    {0.25, 0, 16},
                    {0.015625, 0.125, 16},
                    {0.01513671875, 0.046875, 11},
                    {0, 0.046875, 0},
                    {0.015625, 0.046875, 11},
                    {0.25, 0.125, 11},
                    {0, 0.046844482421875, 6},
                    {0.01513671875, 0.046875, 16},
                    {0.01513671875, 0.046844482421875, 11}};
  const auto facet = [&](std::vector<std::vector<std::uint32_t>> polygons) {
    plate.polygon_facets.push_back(
        {std::move(polygons), {}, 0, static_cast<std::uint32_t>(plate.polygon_facets.size())});
  };
  facet({{0, 1, 2, 3}});
  facet({{4, 5, 6, 7}, {7, 12}});
  facet({{0, 3, 7, 4}});
  facet({{1, 2, 6, 5}, {1, 8}, {12, 8}});
  facet({{0, 4, 5, 1}});
  facet({{3, 7, 6, 2}, {8, 7}, {14, 3}});
  for (const std::uint32_t apex : {1u, 9u, 4u, 10u, 11u, 12u, 13u}) facet({{8, 7, apex}});
  facet({{14, 3, 15}});
  return plate;
}

TEST(Protection, OfSegmentsThatAreNotQuiteParallelEnds) {
  const InputPlc plate = plate_with_narrow_fan();
  const MeshResult result = bare_mesh(plate);
  EXPECT_LT(result.counts.steiner_vertices, 100u);
  expect_verified(plate, result.mesh);
}

TEST(Protection, OfALongEdgeWithFeetNextToItsEndsEnds) {
  const InputPlc stack = stack_of_thin_plates();
  const plc::Plc plc = plc::build_plc(plc::triangulate_warped_facets(stack).value_or(stack));
  const auto [delaunay, chains, grazeable] = protection::protect_edges(
      plc, protection::unprotected(plc, delaunay::build_delaunay(plc.vertices)), Protection::shell);
  EXPECT_LT(delaunay.vertices.size() - plc.vertices.size(), 1000u);
}

TEST(Protection, CubeWithGridsNeedsNoSteinerVertexPlainAndRotated) {
  for (const InputPlc& cube : {gridded_cube(60), rotated(oblique, gridded_cube(60))}) {
    const MeshResult result = bare_mesh(cube);
    EXPECT_EQ(result.counts.steiner_vertices, 0u);
    EXPECT_EQ(result.counts.vertices, 6u * 60 * 60 + 2);
    expect_verified(cube, result.mesh);
  }
}

TEST(Protection, SmallCubesWithGridsNeedNoSteinerVertexHoweverRotated) {
  std::mt19937 random(9);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const InputPlc cube = rotated(random_rotation(random), gridded_cube(1 + i % 5));
    EXPECT_EQ(expect_agreement(cube, Lattice::none).counts.steiner_vertices, 0u);
  }
}

TEST(Protection, EveryGrazeableSegmentBecomesAChainOfDelaunayEdgesThatLieOnIt) {
  for (const Protection strategy : {Protection::shell, Protection::midpoint})
    for (const InputPlc& input : inputs_with_reflex_edges()) {
      const plc::Plc plc = plc::build_plc(input);
      const auto [delaunay, chains, grazeable] = protection::protect_edges(
          plc, protection::unprotected(plc, delaunay::build_delaunay(plc.vertices)), strategy);
      for (std::size_t s = 0; s < chains.size(); ++s) {
        const Point3 &a = plc.vertices[plc.segments[s].ends[0]], &b = plc.vertices[plc.segments[s].ends[1]];
        EXPECT_EQ(chains[s].front().fraction, 0u);
        EXPECT_EQ(chains[s].back().fraction, protection::whole_segment);
        if (!grazeable[s]) {
          EXPECT_EQ(chains[s].size(), 2u);
        }
        for (std::size_t i = 0; i < chains[s].size(); ++i) {
          const protection::ChainVertex& v = chains[s][i];
          EXPECT_EQ(delaunay.point(v.vertex), a + v.fraction * (1.0 / protection::whole_segment * (b - a)));
          if (i == 0) continue;
          EXPECT_LT(chains[s][i - 1].fraction, v.fraction);
          EXPECT_TRUE(!grazeable[s] || has_edge(delaunay, chains[s][i - 1].vertex, v.vertex));
        }
      }
    }
}

/// Slits in a cube, like the pages of a barely open book.
InputPlc cube_with_pages(int pages, double angle) {
  InputPlc plc = seeded_cube();
  plc.vertices.insert(plc.vertices.end(), {{0.5, 1.5, 1}, {0.5, 1.5, 2}});
  for (int i = 0; i < pages; ++i) {
    const auto tip = static_cast<std::uint32_t>(plc.vertices.size());
    plc.vertices.push_back({0.5 + 2 * std::cos(i * angle), 1.5 + 2 * std::sin(i * angle), 1.0 + 0.3 * (i % 3)});
    append_fan(plc, {8, tip, 9});
  }
  return plc;
}

TEST(Protection, SplitsAreCountedByLevelWhichForMidpointsIsTheDepthOfTheBisection) {
  EXPECT_EQ(bare_mesh(plc_test::schoenhardt(), Protection::midpoint).counts.splits_by_level,
            std::vector<std::uint64_t>{3});
  EXPECT_TRUE(bare_mesh(unit_cube()).counts.splits_by_level.empty());
  std::size_t deepest = 0;
  std::vector<InputPlc> inputs = inputs_with_reflex_edges();
  for (const double angle : {0.1, 0.05}) inputs.push_back(cube_with_pages(5, angle));
  for (const InputPlc& input : inputs) {
    const plc::Plc plc = plc::build_plc(input);
    const auto [delaunay, chains, grazeable] = protection::protect_edges(
        plc, protection::unprotected(plc, delaunay::build_delaunay(plc.vertices)), Protection::midpoint);
    const std::size_t added = delaunay.vertices.size() - plc.vertices.size();
    const std::vector<std::uint64_t> splits = protection::count_splits_by_level(chains);
    EXPECT_EQ(std::accumulate(splits.begin(), splits.end(), std::uint64_t{0}), added);
    deepest = std::max(deepest, splits.size());
    std::vector<std::uint64_t> by_level(splits.size(), 0);
    for (std::size_t s = 0; s < chains.size(); ++s)
      for (const protection::ChainVertex& v : chains[s]) {
        if (v.level > 0) ++by_level.at(v.level - 1);
        // A midpoint of depth k is an odd multiple of 2^-k.
        const std::uint32_t unit = protection::whole_segment >> v.level;
        EXPECT_TRUE(v.level == 0 ? v.fraction % protection::whole_segment == 0 : v.fraction / unit % 2 == 1);
        EXPECT_EQ(v.fraction % unit, 0u);
      }
    EXPECT_EQ(by_level, splits);
  }
  EXPECT_GE(deepest, 2u);
}

TEST(Protection, ShellsTerminateWhereSegmentsMeetAtSmallAngles) {
  for (const double angle : {0.1, 0.01, 0.001}) {
    SCOPED_TRACE(angle);
    const InputPlc book = cube_with_pages(5, angle);
    EXPECT_GT(expect_agreement(book, Lattice::none).counts.steiner_vertices, 0u);
    expect_agreement(rotated(oblique, book), Lattice::none);
  }
}

/// A cube with segments side by side, a little skew.
InputPlc cube_with_bundle(double spacing) {
  std::mt19937 random(1);
  const auto offset = [&] { return spacing * static_cast<double>(random() % 8) / 8; };
  InputPlc plc = seeded_cube();
  for (std::uint32_t v = 8; v < 24; ++v) {
    const double x = v % 2 == 0 ? 0.5 : 2.5, dx = offset(), dy = offset(), dz = offset();
    plc.vertices.push_back({x + dx, 1.5 + dy, 1.5 + dz});
    if (v % 2 == 1) plc.segments.push_back({v - 1, v});
  }
  return plc;
}

TEST(Protection, SegmentsSideBySideAreSplitSideBySide) {
  EXPECT_LT(expect_agreement(cube_with_bundle(0x1p-14), Lattice::none).counts.steiner_vertices, 2000u);
  if (is_sanitized) return;
  EXPECT_LT(expect_agreement(cube_with_bundle(0x1p-18), Lattice::none).counts.steiner_vertices, 10000u);
}

TEST(SegmentChains, HoldVerticesInTheOrderOfTheirSegments) {
  const auto id = [](std::uint32_t v) { return VertexId(v); };
  const std::array<plc::Segment, 3> segments = {{{{id(0), id(1)}}, {{id(1), id(2)}}, {{id(2), id(0)}}}};
  protection::SegmentChains chains(segments);
  EXPECT_FALSE(chains.have_inner_vertices());
  constexpr std::uint32_t quarter = protection::whole_segment / 4;
  chains.insert({{2, {id(3), 2 * quarter, 1}}, {0, {id(4), 3 * quarter, 2}}, {2, {id(5), quarter, 0}}});
  chains.insert({{0, {id(6), quarter, 1}}});
  EXPECT_TRUE(chains.have_inner_vertices());

  using Vertices = std::vector<std::uint32_t>;
  const auto vertices_of = [&](std::size_t s) {
    Vertices vertices;
    for (const protection::ChainVertex& v : chains[s]) vertices.push_back(v.vertex);
    return vertices;
  };
  EXPECT_EQ(vertices_of(0), (Vertices{0, 6, 4, 1}));
  EXPECT_EQ(vertices_of(1), (Vertices{1, 2}));
  EXPECT_EQ(vertices_of(2), (Vertices{2, 5, 3, 0}));
  EXPECT_EQ(protection::count_split(chains), 2u);
  EXPECT_EQ(chains.pieces().size(), 7u);
  EXPECT_EQ(chains.pieces()[1], (std::array{id(6), id(4)}));

  chains.erase_if([&](const protection::ChainVertex& v) { return v.vertex == id(6) || v.vertex == id(3); });
  EXPECT_EQ(vertices_of(0), (Vertices{0, 4, 1}));
  EXPECT_EQ(vertices_of(1), (Vertices{1, 2}));
  EXPECT_EQ(vertices_of(2), (Vertices{2, 5, 0}));
  EXPECT_EQ(protection::count_split(chains), 1u);
}

TEST(Protection, FractionsFinerThanUsualAreOnTheGrid) {
  const plc::Plc plc = plc::build_plc(cube_with_bundle(0x1p-16));
  const auto [delaunay, chains, grazeable] = protection::protect_edges(
      plc, protection::unprotected(plc, delaunay::build_delaunay(plc.vertices)), Protection::shell);
  std::size_t fine = 0;
  for (std::size_t s = 0; s < chains.size(); ++s)
    for (const protection::ChainVertex& v : chains[s]) {
      fine += v.fraction % protection::usual_step != 0;
      const auto& [a, b] = plc.segments[s].ends;
      const std::uint32_t parts = protection::whole_segment >> std::min(30, std::countr_zero(v.fraction));
      for (const double along : as_array(plc.vertices[b] - plc.vertices[a])) EXPECT_EQ(std::fmod(along, parts), 0);
    }
  EXPECT_GT(fine, 0u);
}

TEST(Protection, SegmentsSideBySideMayBeTooCloseForTheirPlacesOnTheGrid) {
  EXPECT_NO_THROW(bare_mesh(rotated(oblique, cube_with_bundle(0x1p-12))));
  EXPECT_THROW(bare_mesh(rotated(oblique, cube_with_bundle(0x1p-18))), LimitError);
}

TEST(Protection, MidpointsGiveUpWithTheSegmentWhereThePiecesWouldGetTooSmall) {
  // Three vertices so close around a segment that it would have to be cut into pieces of 1e-8.
  InputPlc input = seeded_cube();
  input.vertices.insert(input.vertices.end(), {{1, 1.5, 1}, {2, 1.5, 1}});
  for (const auto& [y, z] : {std::array{1e-8, 0.0}, {-5e-9, 9e-9}, {-5e-9, -9e-9}})
    input.vertices.push_back({1.3, 1.5 + y, 1 + z});
  input.segments = {{8, 9}};
  try {
    bare_mesh(input, Protection::midpoint);
    FAIL() << "no error";
  } catch (const LimitError& error) {
    ASSERT_EQ(error.place().points.size(), 2u);
    EXPECT_EQ(error.place().points[0], as_array(input.vertices[8]));
    EXPECT_EQ(error.place().points[1], as_array(input.vertices[9]));
    EXPECT_NE(error.remedy(), "");
  }
}

}  // namespace
}  // namespace ccdt
