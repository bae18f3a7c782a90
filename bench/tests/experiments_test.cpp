#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bench/experiments/existence_experiments.h"
#include "bench/experiments/measured_case.h"
#include "bench/experiments/registry.h"
#include "bench/experiments/small_plcs/trial.h"
#include "bench/experiments/surfaces.h"
#include "bench/experiments/timing_experiments.h"
#include "engine/base/errors.h"

namespace ccdt {
namespace {

TEST(BoundTest, HoldsOrFailsOnlyWithTheWholeInterval) {
  EXPECT_EQ(experiments::is_at_most({1, 0.9, 1.05}, 1.1), experiments::BoundTest::holds);
  EXPECT_EQ(experiments::is_at_most({1, 0.9, 1.2}, 1.1), experiments::BoundTest::undecided);
  EXPECT_EQ(experiments::is_at_most({1.3, 1.2, 1.4}, 1.1), experiments::BoundTest::fails);
  EXPECT_EQ(experiments::is_at_least({9, 8.5, 9.5}, 8), experiments::BoundTest::holds);
  EXPECT_EQ(experiments::is_at_least({9, 7.5, 9.5}, 8), experiments::BoundTest::undecided);
  EXPECT_EQ(experiments::is_at_least({7, 6.5, 7.5}, 8), experiments::BoundTest::fails);
}

TEST(Experiments, CountLongRunsLessOften) {
  experiments::ExperimentOptions options;
  options.tetrahedra = 20000;
  experiments::MeasuredCase measured;
  measured.first.seconds.mesh = 1.9;
  EXPECT_TRUE(experiments::is_counted(options, measured, 5));
  EXPECT_FALSE(experiments::is_counted(options, measured, 6));
  measured.first.seconds.mesh = 2.1;
  EXPECT_TRUE(experiments::is_counted(options, measured, 3));
  EXPECT_FALSE(experiments::is_counted(options, measured, 4));
}

TEST(Experiments, MakeEdgesLongerForFewerTetrahedra) {
  experiments::ExperimentOptions options;
  EXPECT_DOUBLE_EQ(experiments::edge_factor(options), 1);
  options.tetrahedra = 12500;
  EXPECT_DOUBLE_EQ(experiments::edge_factor(options), 2);
}

TEST(Registry, NamesEveryExperimentOnceAndGivesItsNameToTheResult) {
  std::set<std::string> names;
  for (const experiments::KnownExperiment& known : experiments::known_experiments())
    EXPECT_TRUE(names.insert(known.name).second) << known.name;
  EXPECT_EQ(experiments::known_experiment("fig8")->section, "6, Fig. 8");
  EXPECT_EQ(experiments::known_experiment("fig12"), nullptr);
}

TEST(Experiments, MeasureAllModelsUnlessSomeAreAskedFor) {
  experiments::ExperimentOptions options;
  EXPECT_TRUE(experiments::is_asked_for(options, "piston"));
  options.models = {"bracket"};
  EXPECT_TRUE(experiments::is_asked_for(options, "bracket"));
  EXPECT_FALSE(experiments::is_asked_for(options, "piston"));
}

TEST(Experiments, TimeMesh3OnlyWhereItCanBeAsCoarse) {
  experiments::ExperimentOptions options;
  options.tetrahedra = 8000;
  EXPECT_TRUE(experiments::is_timed(options, "ccdt"));
  EXPECT_FALSE(experiments::is_timed(options, "cgal-mesh3"));
  options.tetrahedra = 100000;
  EXPECT_EQ(experiments::is_timed(options, "cgal-mesh3"), experiments::is_measured(options, "cgal-mesh3"));
  options.beside = {"tetgen"};
  EXPECT_FALSE(experiments::is_timed(options, "cgal-mesh3"));
}

TEST(Experiments, RefuseToMeasureNothing) {
  EXPECT_NO_THROW(experiments::check_something_is_measured(1, "fig8"));
  EXPECT_THROW(experiments::check_something_is_measured(0, "fig8"), InputError);
}

/// A point whose Delaunay stage takes n^exponent microseconds and whose front takes twice as long as that is linear.
experiments::Fig8Point point_of_size(std::uint64_t n, double exponent) {
  experiments::Fig8Point point;
  point.counts.vertices = n;
  StageSeconds seconds;
  seconds.delaunay = 1e-6 * std::pow(static_cast<double>(n), exponent);
  seconds.front = 2e-6 * static_cast<double>(n);
  point.stages.assign(5, seconds);
  point.seconds = bench::Estimate{seconds.delaunay + seconds.front, 0, 0};
  return point;
}

TEST(Fig8, FitsEachStageOnItsOwn) {
  experiments::Fig8Series series{"without_check", "without check", "ccdt"};
  for (const std::uint64_t n : {10000, 20000, 40000, 80000}) series.points.push_back(point_of_size(n, 1.5));
  const auto fits = experiments::fit_series(series);
  ASSERT_EQ(fits.size(), 3u);
  EXPECT_EQ(fits[0].quantity, "cdt");
  EXPECT_GT(fits[0].power.slope.value, 1.4);
  EXPECT_LT(fits[0].power.slope.value, 1.5);
  EXPECT_EQ(fits[1].quantity, "delaunay");
  EXPECT_NEAR(fits[1].power.slope.value, 1.5, 1e-9);
  EXPECT_EQ(fits[2].quantity, "front");
  EXPECT_NEAR(fits[2].power.slope.value, 1, 1e-9);
  EXPECT_NEAR(fits[2].line.slope.value, 2e-6, 1e-12);
  EXPECT_EQ(fits[0].least_vertices, 10000);
  EXPECT_EQ(fits[0].most_vertices, 80000);
  series.id = "insert";
  EXPECT_EQ(experiments::fit_series(series).size(), 2u);
  series.mesher = "tetgen";
  ASSERT_EQ(experiments::fit_series(series).size(), 0u);  // it tells no seconds of all of its work
}

TEST(Fig8, LeavesOutFailedPointsAndDoesNotFitTwo) {
  experiments::Fig8Series series{"insert", "with check", "ccdt"};
  for (const std::uint64_t n : {10000, 20000, 40000}) series.points.push_back(point_of_size(n, 1));
  series.points.push_back(point_of_size(80000, 7));
  series.points.back().seconds = {};
  EXPECT_NEAR(experiments::fit_series(series)[0].power.slope.value, 1, 1e-9);
  series.points[0].seconds = {};
  EXPECT_TRUE(experiments::fit_series(series).empty());
}

TEST(Locators, ExpectTheOctreeAheadOnlyWhereEdgesDiffer) {
  experiments::LocatorsCase c;
  EXPECT_FALSE(experiments::expectation(c));
  c.octree_over_grid = bench::Estimate{0.5, 0.4, 0.6};
  EXPECT_EQ(experiments::expectation(c), experiments::BoundTest::fails);
  c.kind = experiments::SurfaceKind::graded;
  EXPECT_EQ(experiments::expectation(c), experiments::BoundTest::holds);
  c.octree_over_grid = bench::Estimate{1, 0.9, 1.1};
  EXPECT_EQ(experiments::expectation(c), experiments::BoundTest::undecided);
  c.kind = experiments::SurfaceKind::rough;
  EXPECT_FALSE(experiments::expectation(c));
}

/// A tetrahedron with a dent: its fifth vertex pushes in the face of the first three.
small_plcs::SmallPlc dented_tetrahedron() {
  return {{{0, 0, 0}, {100, 7, 3}, {11, 100, 5}, {23, 29, 100}, {31, 37, 17}},
          {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}}};
}

TEST(InteriorExistence, AddsAPointStrictlyInside) {
  const small_plcs::SmallPlc more = experiments::with_interior_point(dented_tetrahedron(), 7);
  ASSERT_EQ(more.vertices.size(), 6u);
  EXPECT_EQ(more.boundary, dented_tetrahedron().boundary);
  EXPECT_TRUE(is_inside(more, {5}));
  EXPECT_TRUE(is_generic(more));
  EXPECT_EQ(experiments::with_interior_point(dented_tetrahedron(), 7).vertices, more.vertices);
}

TEST(InteriorExistence, IsLostInCounterexamplesThatCanBeLookedAt) {
  std::uint64_t lost = 0;
  for (const experiments::ExistenceTrials& trials : experiments::try_interior_points(20)) {
    EXPECT_GT(trials.cases, 0u) << trials.family;
    if (trials.lost == 0) continue;
    lost += trials.lost;
    small_plcs::SmallPlc plc = trials.counterexample;
    EXPECT_EQ(search_constrained_delaunay(plc).constrained_delaunay, 0u) << in_words(plc);
    plc.vertices.pop_back();
    EXPECT_EQ(search_constrained_delaunay(plc).constrained_delaunay, 1u) << in_words(plc);
  }
  EXPECT_GT(lost, 0u);
}

experiments::InteriorCase interior_case(const char* input, Lattice lattice, experiments::InteriorRule rule,
                                        std::uint64_t placed, std::uint64_t dropped) {
  experiments::InteriorCase c{{}, input, 1, lattice, rule};
  c.counts.interior_vertices = placed;
  c.counts.dropped_interior_vertices = dropped;
  return c;
}

TEST(InteriorPointsSummary, CountsCasesOfARuleAndAsideThoseThatFailed) {
  const std::vector<experiments::InteriorCase> cases = {
      interior_case("a", Lattice::fcc, experiments::InteriorRule::paper, 100, 0),
      interior_case("a", Lattice::bcc, experiments::InteriorRule::paper, 90, 2),
      interior_case("a", Lattice::bcc, experiments::InteriorRule::no_spheres, 95, 7),
      {{baselines::RunStatus::failed, "why"}, "b", 1, Lattice::fcc, experiments::InteriorRule::paper}};
  const experiments::InteriorSummary paper = experiments::summarize(cases, experiments::InteriorRule::paper);
  EXPECT_EQ(paper.cases, 2u);
  EXPECT_EQ(paper.failed, 1u);
  EXPECT_EQ(paper.harmed, 1u);
  EXPECT_EQ(paper.placed, 190u);
  EXPECT_EQ(paper.dropped, 2u);
  EXPECT_EQ(experiments::summarize(cases, experiments::InteriorRule::paper, Lattice::fcc).harmed, 0u);
  EXPECT_EQ(experiments::summarize(cases, experiments::InteriorRule::no_distances).cases, 0u);
}

}  // namespace
}  // namespace ccdt
