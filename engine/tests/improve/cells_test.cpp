#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/improve/find_step.h"
#include "engine/improve/improve_mesh.h"
#include "engine/tests/improve/improve_checks.h"

namespace ccdt {
namespace {

using namespace improve_test;

constexpr double spacing = 1099511627776.0;  // 2^40 grid units

/// A cube of n x n x n small cubes, filled with the Delaunay tetrahedra of their corners. Each corner was moved by a
/// random amount within its face or edge of the large cube, or anywhere if it is inside.
struct Cube {
  Model model;
  std::vector<improve::Freedom> freedom;  ///< of the vertices on the boundary
};

/// For each axis: is the vertex at one of the two ends of the cube?
std::array<bool, 3> at_end(const Point3& p, int n) {
  std::array<bool, 3> result = {};
  for (std::size_t i = 0; i < 3; ++i) result[i] = as_array(p)[i] == 0 || as_array(p)[i] == n * spacing;
  return result;
}

improve::Freedom freedom_of(const std::array<bool, 3>& fixed) {
  std::vector<Point3> steps;
  if (!fixed[0]) steps.push_back({1, 0, 0});
  if (!fixed[1]) steps.push_back({0, 1, 0});
  if (!fixed[2]) steps.push_back({0, 0, 1});
  improve::Freedom freedom;
  freedom.dimensions = static_cast<int>(steps.size());
  if (steps.size() == 3) return freedom;
  if (!steps.empty()) freedom.u = steps[0];
  if (steps.size() == 2) freedom.v = steps[1];
  return freedom;
}

/// The corners of the small cubes, those on the boundary first.
std::vector<Point3> moved_corners(int n, double jitter, std::mt19937& random) {
  std::uniform_real_distribution<double> part(-jitter, jitter);
  std::vector<Point3> boundary, inside;
  for (int i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i) {
    std::array<double, 3> p = {double(i % (n + 1)), double(i / (n + 1) % (n + 1)), double(i / (n + 1) / (n + 1))};
    bool is_inside = true;
    for (double& x : p) {
      const bool is_fixed = x == 0 || x == n;
      is_inside = is_inside && !is_fixed;
      x = is_fixed ? x * spacing : std::round((x + part(random)) * spacing);
    }
    (is_inside ? inside : boundary).push_back({p[0], p[1], p[2]});
  }
  boundary.insert(boundary.end(), inside.begin(), inside.end());
  return boundary;
}

/// The sides of the cube that contain all of these corners, with one bit for each side.
template <std::size_t Corners>
std::uint32_t common_sides(const std::vector<Point3>& points, const std::array<std::uint32_t, Corners>& corners,
                           int n) {
  std::uint32_t sides = 63;
  for (const std::uint32_t v : corners)
    for (std::size_t i = 0; i < 3; ++i) {
      if (as_array(points[v])[i] != 0) sides &= ~(1u << i);
      if (as_array(points[v])[i] != n * spacing) sides &= ~(8u << i);
    }
  return sides;
}

void add_face(Model& model, const Triangle& face, int n) {
  model.faces.push_back(face);
  model.facet_of_face.push_back(common_sides(model.points, face, n));
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge edge = {face[i], face[(i + 1) % 3]};
    const std::uint32_t sides = common_sides(model.points, edge, n);
    if ((sides & (sides - 1)) != 0) model.segments.push_back(edge);
  }
}

Cube cube_of(int n, double jitter, unsigned seed) {
  std::mt19937 random(seed);
  Cube cube;
  cube.model.points = moved_corners(n, jitter, random);
  const auto size = static_cast<std::uint32_t>(cube.model.points.size());
  cube.model.first_interior = size - static_cast<std::uint32_t>((n - 1) * (n - 1) * (n - 1));
  for (std::uint32_t v = 0; v < cube.model.first_interior; ++v)
    cube.freedom.push_back(freedom_of(at_end(cube.model.points[v], n)));
  const delaunay::Delaunay delaunay = delaunay::build_delaunay(cube.model.points);
  for (std::uint32_t c = 0; c < delaunay.cells.size(); ++c) {
    const auto& v = delaunay.cells[c].vertices;
    if (delaunay.is_finite(c))
      cube.model.cells.push_back(v);
    else if (!delaunay.is_dead(c))
      add_face(cube.model, {v[0], v[1], v[2]}, n);
  }
  cube.model.regions.assign(cube.model.cells.size(), 5);
  return cube;
}

struct Case {
  Cube cube;
  improve::ImproveOptions options;
  const std::vector<improve::Freedom>& freedom() const {
    static const std::vector<improve::Freedom> no_freedom;
    return options.boundary == improve::BoundaryRule::slide ? cube.freedom : no_freedom;
  }
};

template <class Visit>
void visit_cases(const Visit& visit) {
  unsigned seed = 0;
  for (const double jitter : {0.0, 0.3, 0.49}) {
    const Cube cube = cube_of(3, jitter, ++seed);
    for (const improve::Improvement improvement :
         {improve::Improvement::swap, improve::Improvement::smooth, improve::Improvement::all})
      for (const tets::Objective objective : {tets::Objective::r, tets::Objective::dihedral})
        for (const improve::BoundaryRule boundary : {improve::BoundaryRule::keep, improve::BoundaryRule::slide}) {
          SCOPED_TRACE("jitter " + std::to_string(jitter) + ", improvement " +
                       std::to_string(static_cast<int>(improvement)) + ", objective " +
                       std::to_string(static_cast<int>(objective)) + ", boundary " +
                       std::to_string(static_cast<int>(boundary)));
          visit(Case{cube, {improvement, objective, boundary, 45, 1.5, 0}});
        }
  }
}

std::vector<CellId> bad_cells(const tets::CellComplex& x, const tets::QualityGoal& goal) {
  std::vector<CellId> bad;
  for (CellId c(0); c < x.cell_count(); c = CellId(c + 1))
    if (!x.is_dead(c) && x.quality(c) < goal.good()) bad.push_back(c);
  return bad;
}

TEST(Improving, FillsTheSameSpaceExactlyAndIsNeverWorse) {
  int slid = 0;
  visit_cases([&](const Case& c) {
    const tets::QualityGoal goal = improve::goal_of(c.options);
    tets::CellComplex x = complex_of(c.cube.model, goal);
    Invariants before = invariants_of(x);
    const double worst = worst_quality(x);
    EXPECT_GT(improve::improve_cells(x, c.freedom(), c.options).bad_cells, 0u);
    expect_consistent(x);
    Invariants after = invariants_of(x);
    if (c.options.boundary == improve::BoundaryRule::slide && c.options.improvement != improve::Improvement::swap) {
      slid += before.places != after.places;
      before.places = after.places = {};
    }
    EXPECT_TRUE(after == before);
    EXPECT_GE(worst_quality(x), worst);
  });
  EXPECT_GT(slid, 0);
}

TEST(Improving, CountsWhatItDid) {
  visit_cases([](const Case& c) {
    const tets::QualityGoal goal = improve::goal_of(c.options);
    tets::CellComplex x = complex_of(c.cube.model, goal);
    const std::size_t bad_before = bad_cells(x, goal).size(), vertices = x.vertex_count();
    const std::vector<Point3> points = points_of(x);
    const std::set<Tetrahedron> cells = cells_of(x);
    const improve::ImproveCounts counts = improve::improve_cells(x, c.freedom(), c.options);
    EXPECT_EQ(counts.bad_cells, bad_before);
    EXPECT_EQ(counts.bad_cells_left, bad_cells(x, goal).size());
    EXPECT_EQ(counts.stop, counts.bad_cells_left == 0 ? improve::ImproveStop::target : improve::ImproveStop::stuck);
    EXPECT_EQ(counts.moved_vertices == 0, points == points_of(x));
    EXPECT_LE(counts.facet_flips, counts.removed_edges);
    EXPECT_TRUE(c.options.improvement != improve::Improvement::swap || counts.moved_vertices == 0);
    if (c.options.improvement == improve::Improvement::smooth) {
      EXPECT_TRUE(cells_of(x) == cells);
      EXPECT_EQ(counts.removed_edges + counts.removed_faces, 0u);
    }
    if (c.options.improvement == improve::Improvement::all) return;
    EXPECT_EQ(counts.inserted_vertices + counts.collapsed_edges, 0u);
    EXPECT_EQ(x.vertex_count(), vertices);
  });
}

TEST(Improving, IsDeterministic) {
  visit_cases([](const Case& c) {
    const tets::QualityGoal goal = improve::goal_of(c.options);
    tets::CellComplex x = complex_of(c.cube.model, goal), y = x;
    improve::improve_cells(x, c.freedom(), c.options);
    improve::improve_cells(y, c.freedom(), c.options);
    EXPECT_TRUE(points_of(x) == points_of(y));
    EXPECT_TRUE(cells_of(x) == cells_of(y));
  });
}

/// Most cells are bad, so that windows are full. Some steps exchange faces on facets.
TEST(Improving, MakesTheSameStepsTogetherAndInTurn) {
  improve::ImproveOptions options{.target_dihedral = 45, .target_r = 1.5};
  std::uint64_t facet_flips = 0, insertions = 0, collapses = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Cube cube = cube_of(6, 0.49, seed);
    const tets::QualityGoal goal = improve::goal_of(options);
    const tets::CellComplex start = complex_of(cube.model, goal);
    for (const auto boundary : {improve::BoundaryRule::keep, improve::BoundaryRule::slide}) {
      options.boundary = boundary;
      const Case c{cube, options};
      tets::CellComplex in_turn = start;
      const improve::ImproveCounts counts =
          with_threads(1, [&] { return improve::improve_cells(in_turn, c.freedom(), options); });
      facet_flips += counts.facet_flips;
      insertions += counts.inserted_vertices;
      collapses += counts.collapsed_edges;
      for (const unsigned threads : {2u, 3u, 8u}) {
        tets::CellComplex together = start;
        with_threads(threads, [&] { return improve::improve_cells(together, c.freedom(), options); });
        expect_consistent(together);
        EXPECT_TRUE(points_of(in_turn) == points_of(together)) << threads << " threads";
        EXPECT_TRUE(cells_of(in_turn) == cells_of(together)) << threads << " threads";
        EXPECT_EQ(in_turn.change_count(), together.change_count());
      }
    }
  }
  EXPECT_GT(facet_flips, 0u);
  EXPECT_GT(insertions, 0u);
  EXPECT_GT(collapses, 0u);
}

TEST(Improving, LeavesNoSwapsOnceItFindsNone) {
  visit_cases([](const Case& c) {
    if (c.options.improvement != improve::Improvement::swap) return;
    const tets::QualityGoal goal = improve::goal_of(c.options);
    tets::CellComplex x = complex_of(c.cube.model, goal);
    std::uint64_t changes = 0;
    do {  // it gives up cells after several attempts; another run tries all of them
      changes = x.change_count();
      improve::improve_cells(x, c.freedom(), c.options);
    } while (x.change_count() != changes);
    tets::Change change;
    for (const CellId cell : bad_cells(x, goal)) {
      for (std::uint32_t edge = 0; edge < 6; ++edge)
        EXPECT_FALSE(tets::plan_edge_removal(x, cell, edge, x.quality(cell), change) && x.all_positive(change));
      for (std::uint32_t face = 0; face < 4; ++face)
        EXPECT_FALSE(tets::plan_face_removal(x, cell, face, x.quality(cell), change) && x.all_positive(change));
    }
  });
}

TEST(Improving, EveryPlanForRandomTetrahedraIsSound) {
  PlanCounts all;
  for (const double jitter : {0.0, 0.49}) {
    for (const tets::Objective objective : {tets::Objective::r, tets::Objective::dihedral}) {
      const tets::QualityGoal goal{objective, 1, 1};
      const tets::CellComplex x = complex_of(cube_of(3, jitter, 7).model, goal);
      const PlanCounts counts = expect_every_plan_is_sound(x);
      all.edge_removals += counts.edge_removals, all.face_removals += counts.face_removals;
      all.facet_flips += counts.facet_flips, all.collapses += counts.collapses, all.insertions += counts.insertions;
    }
  }
  EXPECT_GT(all.edge_removals, 0);
  EXPECT_GT(all.face_removals, 0);
  EXPECT_GT(all.facet_flips, 0);
  EXPECT_GT(all.collapses, 0);
  EXPECT_GT(all.insertions, 0);
}

TEST(Improving, NoneChangesNothing) {
  const improve::ImproveOptions options{.improvement = improve::Improvement::none};
  const tets::QualityGoal goal = improve::goal_of(options);
  tets::CellComplex x = complex_of(cube_of(3, 0.4, 1).model, goal);
  const tets::CellComplex before = x;
  EXPECT_EQ(improve::improve_cells(x, {}, options).stop, improve::ImproveStop::none);
  EXPECT_TRUE(cells_of(x) == cells_of(before));
  EXPECT_TRUE(points_of(x) == points_of(before));
}

TEST(Improving, MovesOfOneStepAreThoseFoundOneAfterTheOther) {
  const improve::ImproveOptions options{.improvement = improve::Improvement::smooth, .target_dihedral = 50};
  const tets::QualityGoal goal = improve::goal_of(options);
  const tets::CellComplex x = complex_of(cube_of(4, 0.4, 1).model, goal);
  const std::vector<improve::Freedom> freedom;  // none for vertices on the boundary
  const improve::StepRules rules{improve::Improvement::smooth, freedom};
  improve::StepScratch scratch;
  improve::Step step;
  std::size_t second_moves = 0;
  for (const CellId c : bad_cells(x, goal)) {
    improve::find_step(x, rules, c, false, improve::Effort::usual, scratch, step);
    if (step.kind != improve::Step::Kind::moves) continue;
    tets::CellComplex moved = x;
    for (std::size_t i = 0; i < step.move_count; ++i) {
      const improve::Move& move = step.moves[i];
      tets::CellSet star;
      star.gather_star(moved, move.vertex);
      std::vector<improve::StarFace> faces;
      double worst = 2;
      for (const CellId cell : star.cells()) {
        const auto [p, q, r] = tets::corners_of_face(moved.cell(cell).vertices, moved.place(cell, move.vertex));
        faces.push_back({moved.point(p), moved.point(q), moved.point(r)});
        worst = std::min(worst, moved.quality(cell));
      }
      Point3 place = moved.point(move.vertex);
      improve::move_apex(faces, goal, {}, worst, scratch.plan.move, place);
      EXPECT_TRUE(place == move.place) << "cell " << c << ", move " << i;
      EXPECT_TRUE(star.cells() == move.star);
      moved.move_vertex(move.vertex, move.place, move.star);
      second_moves += i > 0;
    }
    expect_consistent(moved);
  }
  EXPECT_GT(second_moves, 0u);
}

TEST(Improving, ReachesALowTarget) {
  improve::ImproveOptions options{
      improve::Improvement::all, tets::Objective::dihedral, improve::BoundaryRule::keep, 5, 2, 0};
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const tets::QualityGoal goal = improve::goal_of(options);
    tets::CellComplex x = complex_of(cube_of(4, 0.4, seed).model, goal);
    EXPECT_LT(worst_quality(x), goal.sine);
    EXPECT_EQ(improve::improve_cells(x, {}, options).stop, improve::ImproveStop::target);
    EXPECT_GE(worst_quality(x), goal.sine);
  }
}

TEST(Improving, LeavesAConsistentMeshWhenTheTimeIsUp) {
  improve::ImproveOptions options{
      improve::Improvement::all, tets::Objective::r, improve::BoundaryRule::keep, 60, 1, 1e-9};
  const tets::QualityGoal goal = improve::goal_of(options);
  for (const double time : {1e-9, 1e-3, 1e-2}) {
    options.time = time;
    tets::CellComplex x = complex_of(cube_of(7, 0.4, 3).model, goal);
    const Invariants before = invariants_of(x);
    const improve::ImproveCounts counts = improve::improve_cells(x, {}, options);
    EXPECT_EQ(counts.stop, improve::ImproveStop::time);
    EXPECT_EQ(counts.bad_cells_left, bad_cells(x, goal).size());
    expect_consistent(x);
    EXPECT_TRUE(invariants_of(x) == before);
  }
}

}  // namespace
}  // namespace ccdt
