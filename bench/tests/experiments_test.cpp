#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bench/experiments/existence_experiments.h"
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
  for (const experiments::KnownExperiment& known : experiments::known_experiments()) {
    EXPECT_TRUE(names.insert(known.name).second) << known.name;
    if (known.name == "fig8") {
      EXPECT_EQ(known.section, "6, Fig. 8");
    }
  }
  EXPECT_TRUE(names.contains("fig8"));
}

TEST(Experiments, MeasureAllModelsUnlessSomeAreAskedFor) {
  experiments::ExperimentOptions options;
  EXPECT_TRUE(experiments::is_chosen(options, "piston"));
  options.models = {"bracket"};
  EXPECT_TRUE(experiments::is_chosen(options, "bracket"));
  EXPECT_FALSE(experiments::is_chosen(options, "piston"));
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
  const small_plcs::SmallPlc more = small_plcs::with_interior_point(dented_tetrahedron(), 7);
  ASSERT_EQ(more.vertices.size(), 6u);
  EXPECT_EQ(more.boundary, dented_tetrahedron().boundary);
  EXPECT_TRUE(is_inside(more, {5}));
  EXPECT_TRUE(is_generic(more));
  EXPECT_EQ(small_plcs::with_interior_point(dented_tetrahedron(), 7).vertices, more.vertices);
}

TEST(InteriorExistence, IsLostInCounterexamplesThatCanBeLookedAt) {
  std::uint64_t lost = 0;
  for (const small_plcs::ExistenceTrials& trials : small_plcs::try_interior_points(20)) {
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

experiments::InteriorRow interior_row(const char* rule, Lattice lattice, std::uint64_t placed, std::uint64_t dropped) {
  experiments::InteriorRow row{{}, "cube", 0.5, rule, lattice};
  bench::RunRecord run;
  run.counts.interior_vertices = placed;
  run.counts.dropped_interior_vertices = dropped;
  bench::add_run(row.measured, run);
  return row;
}

TEST(InteriorPoints, ResultCountsTheHarmAndTheCasesThatFailedApart) {
  std::vector<experiments::InteriorRow> rows = {
      interior_row("paper", Lattice::fcc, 1000, 0), interior_row("paper", Lattice::bcc, 90, 0),
      interior_row("no spheres", Lattice::fcc, 1200, 3), interior_row("paper", Lattice::sc, 7, 7)};
  rows.back().measured.asked.name = "part.off, sc, paper";
  rows.back().measured.first.set_failure(baselines::FailureKind::invalid_input, "it is open");
  const small_plcs::ExistenceTrials existence{"segments", 40, 7, {}};
  const auto result = experiments::interior_points_result(rows, std::vector{existence});
  EXPECT_EQ(
      result.findings,
      (std::vector<std::string>{
          "7 of 40 small PLCs with a CDT have none when one interior point is added",
          "Rule \"paper\": no point threatened an edge in 2 cases with 1,090 interior vertices",
          "Rule \"no spheres\": points threaten edges: 3 points of 1,203 are in the sphere of a protected edge, in 1 "
          "of 1 cases",
          "Rule \"no distances\": no case to judge by"}));
  EXPECT_EQ(result.problems, std::vector<std::string>{"part.off, sc, paper: failed: it is open"});
  EXPECT_EQ(results::find_table(result, "cases")->rows.size(), 4u);
  const results::ResultTable& rules = *results::find_table(result, "rules");
  EXPECT_EQ(results::number_in(rules, rules.rows.at(0), "interior_vertices"), 1000);  // paper, fcc
  EXPECT_EQ(results::number_in(rules, rules.rows.at(3), "cases"), 2);                 // paper, all
}

}  // namespace
}  // namespace ccdt
