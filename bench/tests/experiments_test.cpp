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
