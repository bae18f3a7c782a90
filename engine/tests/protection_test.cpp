#include <gtest/gtest.h>

#include <numeric>

#include "engine/base/errors.h"
#include "engine/delaunay/delaunay.h"
#include "engine/plc/bent_facets.h"
#include "engine/plc/build_plc.h"
#include "engine/protection/protect_edges.h"
#include "engine/tests/mesh_checks.h"
#include "engine/tests/mesh_test_solids.h"
#include "models/solids.h"

namespace ccdt {
namespace {

using namespace mesh_test;

MeshResult bare_mesh(const InputPlc& input, Protection protection = Protection::shell) {
  MeshOptions options;
  options.lattice = Lattice::none;
  options.protection = protection;
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

/// A thin plate with a fan of long triangles inside, the corners of which are nearly on lines. Their edges are not
/// quite parallel, so that the feet of the vertices of one on another one move on with each split.
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

/// A stack of rotated plates with a thickness of 1e-5 of their length and coordinates that are rounded to 1e-7 of it.
/// Vertices next to the ends of the long edges have their feet within 1e-6 of these.
InputPlc stack_of_thin_plates() {
  InputPlc stack;
  stack.name = "stack of thin plates";
  stack.vertices = {{-3.480911254882812e-08, 2.1338462829589843e-08, 2.372264862060547e-08},
                    {0.3589743354305243, 0.8717948340651317, -0.33333329810698825},
                    {0.31250000089406965, 0.874999990940094, -0.37500003224611284},
                    {-0.04647441238012069, 0.003205156278915894, -0.04166665563980738},
                    {-0.6105768980429723, 0.4903845797410378, 0.6250000494718552},
                    {-0.5641025867523292, 0.4871794681656055, 0.6666666428844134},
                    {-0.20512819237281113, 1.358974312840364, 0.33333328612645463},
                    {-0.25160257000342395, 1.3621795255648785, 0.2916666755477587},
                    {-1.174679482709139, 0.977564106855637, 1.2916666786472002},
                    {-1.1282050924423412, 0.9743590049957618, 1.3333333412011463},
                    {-0.7692307821649771, 1.846153823384872, 1.000000028014183},
                    {-0.8157051813724714, 1.8493589462255822, 0.958333303173383},
                    {-1.1746880462429463, 0.9775715847917091, 1.2916768936117489},
                    {-1.128213781265112, 0.9743664109890278, 1.3333434717655182},
                    {-0.7692393781237113, 1.846161224848185, 1.000010162929694},
                    {-0.8157137387073958, 1.849366386789542, 0.9583434969782829},
                    {-1.1746967294628803, 0.9775789619959318, 1.2916870124340054},
                    {-1.1282223701308935, 0.974373829022432, 1.3333536968032518},
                    {-0.7692479668702834, 1.846168695393281, 1.0000203627546627},
                    {-0.8157223968337743, 1.8493738047037367, 0.9583537152806917},
                    {-1.1747138653519826, 0.9775938834761961, 1.2917073174913722},
                    {-1.1282395196098547, 0.9743887013288645, 1.3333740328550339},
                    {-0.7692652585659271, 1.8461836046545934, 1.0000406980911891},
                    {-0.8157395468491774, 1.8493887643905786, 0.9583739798069},
                    {-1.1747310847471921, 0.9776086672697312, 1.2917276494304337},
                    {-1.1282567303027862, 0.9744035935432483, 1.3333943652709324},
                    {-0.7692824535828369, 1.8461984993127676, 1.0000610157847405},
                    {-0.8157567521776907, 1.8494035348922777, 0.9583943401177724}};
  const std::vector<std::vector<std::uint32_t>> quads = {
      {0, 1, 2, 3},     {0, 3, 4, 5},     {0, 5, 6, 1},     {1, 2, 7, 6},     {3, 4, 7, 2},     {5, 6, 7, 4},
      {5, 4, 8, 9},     {5, 9, 10, 6},    {6, 7, 11, 10},   {4, 8, 11, 7},    {9, 10, 11, 8},   {9, 8, 12, 13},
      {9, 13, 14, 10},  {10, 11, 15, 14}, {8, 12, 15, 11},  {13, 14, 15, 12}, {13, 12, 16, 17}, {13, 17, 18, 14},
      {14, 15, 19, 18}, {12, 16, 19, 15}, {17, 18, 19, 16}, {17, 16, 20, 21}, {17, 21, 22, 18}, {18, 19, 23, 22},
      {16, 20, 23, 19}, {21, 22, 23, 20}, {21, 20, 24, 25}, {21, 25, 26, 22}, {22, 23, 27, 26}, {20, 24, 27, 23},
      {25, 26, 27, 24}};
  for (const std::vector<std::uint32_t>& quad : quads)
    stack.polygon_facets.push_back({{quad}, {}, 0, static_cast<std::uint32_t>(stack.polygon_facets.size())});
  return stack;
}

TEST(Protection, OfALongEdgeWithFeetNextToItsEndsEnds) {
  const InputPlc stack = stack_of_thin_plates();
  const plc::Plc plc = plc::build_plc(plc::triangulate_bent_facets(stack).value_or(stack));
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
      delaunay::CellStar star(delaunay);
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
          EXPECT_TRUE(!grazeable[s] || star.has_edge(chains[s][i - 1].vertex, v.vertex));
        }
      }
    }
}

/// Slits like the pages of a book that is hardly open, in a cube.
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
    for (const auto& chain : chains)
      for (const protection::ChainVertex& v : chain) {
        // A midpoint of depth k is an odd multiple of 2^-k.
        const std::uint32_t unit = protection::whole_segment >> v.level;
        EXPECT_TRUE(v.level == 0 ? v.fraction % protection::whole_segment == 0 : v.fraction / unit % 2 == 1);
        EXPECT_EQ(v.fraction % unit, 0u);
      }
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
