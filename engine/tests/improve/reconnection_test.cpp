#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/delaunay/delaunay.h"
#include "engine/improve/plan_reconnection.h"
#include "engine/steiner/loosen_star.h"
#include "engine/tests/improve/improve_checks.h"

namespace ccdt {
namespace {

using namespace improve_test;

constexpr tets::QualityGoal goal{tets::Objective::r, 1, 1};

/// The Delaunay tetrahedra of random points. Some of their edges are segments, and some of their faces facets.
Model random_tetrahedra(std::mt19937& random) {
  Model model;
  std::uniform_real_distribution<double> place(0, 1e6);
  for (int i = 0; i < 60; ++i)
    model.points.push_back({std::round(place(random)), std::round(place(random)), std::round(place(random))});
  const delaunay::Delaunay d = delaunay::build_delaunay(model.points);
  model.points.clear();
  for (const auto& vertex : d.vertices) model.points.push_back(vertex.point);
  for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
    if (!d.is_finite(c)) continue;
    const auto& [a, b, e, f] = d.cells[c].vertices;
    model.cells.push_back({a, b, e, f});
    if (random() % 10 == 0) model.segments.push_back({a, b});
    const std::uint32_t next = delaunay::cell_of(d.cells[c].neighbors[3]);
    if (random() % 20 == 0 && d.is_finite(next) && next > c) {
      model.facet_of_face.push_back(static_cast<std::uint32_t>(model.faces.size()));
      model.faces.push_back({a, b, e});
    }
  }
  return model;
}

/// With bad cells everywhere.
tets::CellComplex bad_complex(std::mt19937& random) {
  tets::CellComplex x = complex_of(random_tetrahedra(random), goal);
  steiner::Loosening loosening;
  for (std::uint32_t v = 0; v < x.vertex_count(); v += 3) loosen_star(x, v, 250, loosening);
  return x;
}

bool has_swap(const tets::CellComplex& x, CellId cell) {
  tets::Change change;
  for (std::uint32_t edge = 0; edge < 6; ++edge)
    if (plan_edge_removal(x, cell, edge, x.quality(cell), change)) return true;
  for (std::uint32_t face = 0; face < 4; ++face)
    if (plan_face_removal(x, cell, face, x.quality(cell), change)) return true;
  return false;
}

TEST(Reconnection, FillsTheSameSpaceWithBetterCellsEvenWhereNoSwapDoes) {
  std::mt19937 random(1);
  int plans = 0, plans_without_swaps = 0;
  for (int i = 0; i < 30; ++i) {
    tets::CellComplex x = bad_complex(random);
    const Invariants before = invariants_of(x);
    improve::ReconnectionScratch scratch;
    tets::Change change;
    for (CellId c(0); c < x.cell_count(); c = CellId(c + 1)) {
      if (x.is_dead(c)) continue;
      const double quality = x.quality(c);
      const bool can_swap = has_swap(x, c);
      if (!improve::plan_reconnection(x, c, quality, scratch, change)) continue;
      ++plans, plans_without_swaps += !can_swap;
      EXPECT_NE(std::ranges::find(change.old_cells, c), change.old_cells.end());
      EXPECT_TRUE(scratch.cells.cells() == change.old_cells);
      for (const tets::NewCell& cell : change.new_cells) EXPECT_GT(cell.quality, quality);
      ASSERT_TRUE(x.all_positive(change));
      apply_change(x, change);
    }
    expect_consistent(x);
    EXPECT_TRUE(invariants_of(x) == before);
  }
  EXPECT_GT(plans, 100);
  EXPECT_GT(plans_without_swaps, 10);
}

TEST(Reconnection, LeavesCellsAsGoodAsAnyAlone) {
  tets::CellComplex x =
      complex_of({.points = {{0, 0, 0}, {0, 4, 4}, {4, 0, 4}, {4, 4, 0}}, .cells = {{0, 1, 2, 3}}}, goal);
  tets::Change change;
  improve::ReconnectionScratch scratch;
  EXPECT_FALSE(improve::plan_reconnection(x, CellId(0), x.quality(CellId(0)), scratch, change));
}

}  // namespace
}  // namespace ccdt
