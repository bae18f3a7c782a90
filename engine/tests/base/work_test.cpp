#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/merge_sort.h"
#include "engine/base/portable_math.h"
#include "engine/delaunay/delaunay.h"
#include "engine/mesher.h"
#include "engine/surface/remesh_surface.h"
#include "engine/tests/shared/mesh_test_solids.h"

// Work counts are exact, so those of small inputs are recorded here. When an algorithm changes, so do they, and the
// test says by how much. Check whether that was intended, then record the new ones.

namespace ccdt {
namespace {

using namespace mesh_test;

std::vector<Point3> random_points(std::size_t n) {
  std::vector<Point3> points;
  std::uint64_t state = 1;
  const auto random = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 33);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const double x = random(), y = random(), z = random();
    points.push_back({x, y, z});
  }
  return points;
}

template <class Task>
Work work_of(const Task& task) {
  Work work;
  const WorkScope scope(work);
  task();
  return work;
}

/// The counts that are not zero, one per line.
std::string text_of(const std::string& stage, const Work& work) {
  std::string text;
  for (const WorkCount& c : work_counts)
    if (work.*c.count != 0) text += stage + "." + c.name + " " + std::to_string(work.*c.count) + "\n";
  return text;
}

std::string text_of(const StageCosts& costs) {
  std::string text;
  for (const NamedValue<Stage>& stage : names_of(Stage{}))
    text += text_of(std::string(stage.name), costs[stage.value].work);
  return text;
}

InputPlc remeshed(const InputPlc& input, double edge_length) {
  surface::RemeshOptions options;
  options.edge_length = edge_length;
  return surface::remesh_surface(input, options);
}

void expect_work(const std::string& text, const std::string& expected) {
  EXPECT_EQ("\n" + text, expected);
}

TEST(Work, HasAnotherNameForEachCount) {
  std::set<std::string> names;
  for (const WorkCount& c : work_counts) EXPECT_TRUE(names.insert(c.name).second) << c.name;
  for (const WorkCount& c : limit_counts) EXPECT_TRUE(names.insert(c.name).second) << c.name;
}

TEST(Work, CountsTheLimitThatKeepsTheTrianglesOfAThinPlateLong) {
  MeshOptions options;
  options.surface = SurfaceRule::refine, options.lattice = Lattice::none, options.edge_length = 0.2;
  const auto limits = [&](double thickness) {
    return mesh_plc(plc_test::box({0, 0, 0}, {1, 1, thickness}), options).costs[Stage::refine].work.feature_triangles;
  };
  EXPECT_EQ(limits(0.5), 0u);
  EXPECT_EQ(limits(1e-3), 1u);
}

TEST(Work, IsAddedUpButTheLargestStaysTheLargest) {
  Work work, more;
  work.walk_steps = 3, work.largest_cavity = 7, work.peak_bytes = 10;
  more.walk_steps = 5, more.largest_cavity = 6, more.peak_bytes = 20;
  work += more;
  EXPECT_EQ(work.walk_steps, 8u);
  EXPECT_EQ(work.largest_cavity, 7u);
  EXPECT_EQ(work.peak_bytes, 20u);
}

TEST(Work, OfAScopeIsTheSameInsideOthersAndIsTheirsToo) {
  const Work alone = work_of([] { delaunay::build_delaunay(random_points(500)); });
  Work inner;
  const Work outer = work_of([&] {
    delaunay::build_delaunay(random_points(100));
    inner = work_of([] { delaunay::build_delaunay(random_points(500)); });
    delaunay::build_delaunay(random_points(100));
  });
  EXPECT_EQ(inner, alone);
  EXPECT_EQ(outer.insertions, 96u + 496u + 96u);
  EXPECT_EQ(outer.largest_cavity, inner.largest_cavity);
}

TEST(Work, OfAScopeIsKeptWhereAnExceptionEndsIt) {
  Work work;
  try {
    const WorkScope scope(work);
    delaunay::build_delaunay(random_points(100));
    throw std::runtime_error("an end");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(work.insertions, 96u);
}

TEST(Work, OfAMeshIsTheSameAgainAndInsideOtherWork) {
  const InputPlc plc = rotated(oblique, gridded_cube(4));
  const MeshResult first = mesh_plc(plc);
  MeshResult second, third;
  const Work around = work_of([&] {
    second = mesh_plc(gridded_cube(3));
    third = mesh_plc(plc);
  });
  EXPECT_EQ(text_of(third.costs), text_of(first.costs));
  std::uint64_t of_first = 0, of_second = 0;
  for (const Stage stage : {Stage::delaunay, Stage::protect, Stage::improve}) {
    of_first += first.costs[stage].work.cells_created;
    of_second += second.costs[stage].work.cells_created;
  }
  EXPECT_EQ(around.cells_created - of_second, of_first);
}

TEST(Work, CellsThatWereMadeAndNotDestroyedAreThere) {
  delaunay::Delaunay d;
  const Work inserted = work_of([&] { d = delaunay::build_delaunay(random_points(3000)); });
  EXPECT_EQ(inserted.cells_created - inserted.cells_destroyed, d.cells.size() - d.free_cells.size());
  EXPECT_EQ(inserted.insertions, 2996u);
  EXPECT_GE(inserted.walk_steps, inserted.insertions);
  EXPECT_GE(inserted.cells_tested + inserted.insertions, inserted.cells_destroyed);
  delaunay::Delaunay wrapped;
  const Work wrap = work_of([&] { wrapped = delaunay::wrap_delaunay(d.vertices); });
  EXPECT_EQ(wrap.cells_created, wrapped.cells.size());
  EXPECT_EQ(wrap.cells_created, inserted.cells_created - inserted.cells_destroyed);
}

TEST(Work, CellsThatImprovementMadeAndDidNotDestroyAreThere) {
  MeshOptions options;
  options.improve.improvement = Improvement::none;
  const InputPlc plc = rotated(oblique, cube_with_cubic_hole());
  const MeshResult before = mesh_plc(plc, options);
  options.improve.improvement = Improvement::all;
  options.improve.target_dihedral = 40;
  const MeshResult after = mesh_plc(plc, options);
  EXPECT_EQ(before.costs[Stage::improve].work, Work());
  EXPECT_GT(after.costs[Stage::improve].work.cells_created, 0u);
  EXPECT_EQ(after.costs[Stage::improve].work.cells_created - after.costs[Stage::improve].work.cells_destroyed,
            after.counts.tetrahedra - before.counts.tetrahedra);
  EXPECT_EQ(after.costs[Stage::improve].work.vertices_moved, after.counts.improve.moved_vertices);
}

TEST(Work, ExactEvaluationsAreTheSumOfTheirKinds) {
  for (const DelaunayMethod method : {DelaunayMethod::insert, DelaunayMethod::core, DelaunayMethod::wrap}) {
    MeshOptions options;
    options.delaunay = method, options.least_core = 0;
    const MeshResult result = mesh_plc(gridded_cube(4), options);
    for (const NamedValue<Stage>& stage : names_of(Stage{})) {
      const Work& work = result.costs[stage.value].work;
      EXPECT_EQ(work.exact_evaluations, work.narrow_evaluations + work.wide_evaluations + work.perturbed_ties)
          << stage.name;
    }
  }
}

// ---- Exactly so much

TEST(WorkOfSmallInputs, DelaunayOfRandomPoints) {
  expect_work(text_of("random", work_of([] { delaunay::build_delaunay(random_points(1000)); })), R"(
random.insertions 996
random.walk_steps 5389
random.cells_tested 47560
random.cells_created 27499
random.cells_destroyed 21062
random.largest_cavity 67
random.peak_bytes 253405
)");
}

TEST(WorkOfSmallInputs, CubeFilledWithALattice) {
  expect_work(text_of(mesh_plc(rotated(oblique, gridded_cube(3))).costs), R"(
plc.box_tree_nodes 365
plc.box_pairs 203
plc.cells_visited 297
plc.faces_tested 594
plc.peak_bytes 17872
protect.peak_bytes 11520
facets.orient3d_filter_failures 95
facets.narrow_evaluations 73
facets.wide_evaluations 22
facets.exact_evaluations 95
facets.cells_visited 1897
facets.edges_tested 199
facets.edges_flipped 19
facets.triangles_visited 490
facets.peak_bytes 1728
lattice.octree_nodes 137
lattice.box_tree_nodes 121
lattice.octree_nodes_created 137
lattice.rays_cast 15
lattice.ray_triangles 176
lattice.sites_tested 72
lattice.obstacles_tested 2338
lattice.peak_bytes 24508
delaunay.orient3d_filter_failures 60
delaunay.insphere_filter_failures 45
delaunay.narrow_evaluations 105
delaunay.exact_evaluations 105
delaunay.insertions 59
delaunay.walk_steps 231
delaunay.cells_tested 1811
delaunay.cells_created 1111
delaunay.cells_destroyed 764
delaunay.largest_cavity 45
delaunay.peak_bytes 13810
face_check.orient3d_filter_failures 41
face_check.narrow_evaluations 35
face_check.wide_evaluations 6
face_check.exact_evaluations 41
face_check.cells_visited 1434
face_check.edges_tested 65
face_check.edges_flipped 5
face_check.triangles_visited 222
face_check.faces_tested 1572
face_check.peak_bytes 1984
label.cells_visited 174
label.peak_bytes 14836
finish.cells_visited 156
finish.peak_bytes 5520
improve.orient3d_filter_failures 36
improve.narrow_evaluations 34
improve.wide_evaluations 2
improve.exact_evaluations 36
improve.cells_created 59
improve.cells_destroyed 77
improve.changes_tried 220
improve.quality_evaluations 1022
improve.peak_bytes 25796
)");
}

TEST(WorkOfSmallInputs, CubeWrappedFaceByFace) {
  MeshOptions options;
  options.delaunay = DelaunayMethod::wrap;
  options.lattice = Lattice::bcc;
  expect_work(text_of("delaunay", mesh_plc(gridded_cube(3), options).costs[Stage::delaunay].work), R"(
delaunay.orient3d_filter_failures 1428
delaunay.insphere_filter_failures 186
delaunay.narrow_evaluations 1614
delaunay.perturbed_ties 193
delaunay.exact_evaluations 1807
delaunay.grid_cells 6736
delaunay.cells_created 288
delaunay.apex_searches 288
delaunay.vertices_examined 3646
delaunay.peak_bytes 16400
)");
}

TEST(WorkOfSmallInputs, SegmentsThatNeedProtection) {
  MeshOptions options;
  options.lattice = Lattice::none;
  expect_work(text_of("protect", mesh_plc(plc_test::schoenhardt(), options).costs[Stage::protect].work), R"(
protect.insertions 3
protect.walk_steps 5
protect.cells_tested 36
protect.cells_created 26
protect.cells_destroyed 13
protect.largest_cavity 5
protect.cells_visited 51
protect.peak_bytes 1124
)");
}

/// The front of a solid with faces that are not Delaunay.
std::string work_of_front(LocatorKind locator, bool face_protection) {
  MeshOptions options;
  options.lattice = Lattice::none;
  options.locator = locator;
  options.face_protection = face_protection;
  const StageCosts costs = mesh_plc(rotated(oblique, two_bars()), options).costs;
  return text_of("face_check", costs[Stage::face_check].work) + text_of("front", costs[Stage::front].work);
}

TEST(WorkOfSmallInputs, FrontWithEachLocator) {
  expect_work(work_of_front(LocatorKind::cavity, true), R"(
face_check.box_tree_nodes 35
face_check.box_pairs 125
face_check.cells_visited 107
face_check.faces_tested 236
face_check.peak_bytes 768
front.orient3d_filter_failures 10
front.centroid_filter_failures 3
front.narrow_evaluations 10
front.exact_evaluations 10
front.octree_nodes 287
front.cells_visited 85
front.octree_nodes_created 14
front.front_candidates 266
front.visibility_tests 174
front.piercing_tests 143
front.peak_bytes 8104
)");
  expect_work(work_of_front(LocatorKind::octree, true), R"(
face_check.box_tree_nodes 35
face_check.box_pairs 125
face_check.cells_visited 107
face_check.faces_tested 236
face_check.peak_bytes 768
front.orient3d_filter_failures 12
front.centroid_filter_failures 4
front.narrow_evaluations 12
front.exact_evaluations 12
front.octree_nodes 421
front.cells_visited 53
front.octree_nodes_created 31
front.front_candidates 336
front.visibility_tests 195
front.peak_bytes 14560
)");
  expect_work(work_of_front(LocatorKind::grid, true), R"(
face_check.box_tree_nodes 35
face_check.box_pairs 125
face_check.cells_visited 107
face_check.faces_tested 236
face_check.peak_bytes 768
front.orient3d_filter_failures 48
front.centroid_filter_failures 16
front.narrow_evaluations 48
front.exact_evaluations 48
front.grid_cells 725
front.cells_visited 53
front.front_candidates 239
front.visibility_tests 679
front.peak_bytes 11864
)");
}

TEST(WorkOfSmallInputs, FrontOverAllFaces) {
  expect_work(work_of_front(LocatorKind::cavity, false), R"(
face_check.box_tree_nodes 35
face_check.box_pairs 125
face_check.cells_visited 107
face_check.faces_tested 236
face_check.peak_bytes 768
front.orient3d_filter_failures 24
front.centroid_filter_failures 7
front.narrow_evaluations 24
front.exact_evaluations 24
front.octree_nodes 347
front.cells_visited 356
front.octree_nodes_created 14
front.front_candidates 295
front.visibility_tests 246
front.piercing_tests 143
front.peak_bytes 16392
)");
  expect_work(work_of_front(LocatorKind::octree, false), R"(
face_check.box_tree_nodes 35
face_check.box_pairs 125
face_check.cells_visited 107
face_check.faces_tested 236
face_check.peak_bytes 768
front.orient3d_filter_failures 30
front.centroid_filter_failures 9
front.narrow_evaluations 30
front.exact_evaluations 30
front.octree_nodes 784
front.octree_nodes_created 31
front.front_candidates 660
front.visibility_tests 361
front.peak_bytes 16704
)");
}

TEST(WorkOfSmallInputs, Improvement) {
  MeshOptions options;
  options.improve.target_dihedral = 40;
  options.improve.boundary = BoundaryRule::slide;
  expect_work(text_of("improve", mesh_plc(gridded_cube(3), options).costs[Stage::improve].work), R"(
improve.orient3d_filter_failures 294
improve.narrow_evaluations 293
improve.wide_evaluations 1
improve.exact_evaluations 294
improve.cells_created 180
improve.cells_destroyed 163
improve.changes_tried 1210
improve.moves_tried 178
improve.vertices_moved 48
improve.ascent_steps 196
improve.quality_evaluations 23068
improve.peak_bytes 19437
)");
}

TEST(WorkOfSmallInputs, RemeshedSurface) {
  expect_work(text_of("remesh", work_of([] { remeshed(unit_cube(), 0.3); })), R"(
remesh.orient3d_filter_failures 12
remesh.narrow_evaluations 12
remesh.exact_evaluations 12
remesh.box_tree_nodes 11942
remesh.box_pairs 5404
remesh.edges_flipped 12
remesh.moves_tried 810
remesh.vertices_moved 810
remesh.remesh_rounds 8
remesh.edges_split 246
remesh.edges_collapsed 120
remesh.triangles_evaluated 15705
remesh.peak_bytes 33072
)");
}

// ---- The basis for equal work on every machine

TEST(Work, OfSortingIsTheSameWithEveryStandardLibrary) {
  std::vector<std::pair<int, int>> items;
  for (int i = 0; i < 100; ++i) items.emplace_back(i * 37 % 10, i);
  std::vector<std::pair<int, int>> expected = items;
  std::ranges::stable_sort(expected, {}, &std::pair<int, int>::first);
  std::size_t comparisons = 0;
  merge_sort(items, [&](const auto& a, const auto& b) {
    ++comparisons;
    return a.first < b.first;
  });
  EXPECT_EQ(items, expected);
  EXPECT_EQ(comparisons, 573u);
  for (std::size_t n = 0; n < 20; ++n) {
    std::vector<int> few;
    for (std::size_t i = 0; i < n; ++i) few.push_back(static_cast<int>(i * 7 % 5));
    std::vector<int> sorted = few;
    std::ranges::sort(sorted);
    merge_sort(few, std::less<>());
    EXPECT_EQ(few, sorted);
  }
}

TEST(Work, RestsOnFunctionsThatAreAsGoodAsTheLibrarys) {
  for (int i = 1; i < 1000; ++i) {
    const double x = 1e-3 * i, angle = x * portable::pi;
    EXPECT_NEAR(portable::arc_cosine(2 * x - 1), std::acos(2 * x - 1), 1e-14);
    EXPECT_NEAR(portable::angle_of(std::cos(angle), std::sin(angle)), angle, 1e-14);
    EXPECT_NEAR(portable::sine(2 * angle), std::sin(2 * angle), 1e-14);
    EXPECT_NEAR(portable::cosine(1.5 * angle), std::cos(1.5 * angle), 1e-14);
    const double cube = std::ldexp(x, i % 90 - 45);
    EXPECT_NEAR(portable::cube_root(cube) / std::cbrt(cube), 1, 1e-14);
  }
  EXPECT_EQ(portable::angle_of(1, 0), 0);
  EXPECT_EQ(portable::angle_of(-1, 0), portable::pi);
  EXPECT_EQ(portable::angle_of(0, 1), portable::pi / 2);
  EXPECT_EQ(portable::arc_cosine(1), 0);
  EXPECT_EQ(portable::arc_cosine(-1), portable::pi);
  EXPECT_EQ(portable::cube_root(27), 3);
}

}  // namespace
}  // namespace ccdt
