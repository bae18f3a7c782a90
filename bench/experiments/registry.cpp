#include "bench/experiments/registry.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "bench/experiments/density.h"
#include "bench/experiments/existence_experiments.h"
#include "bench/experiments/min_sphere.h"
#include "bench/experiments/quality_experiments.h"
#include "bench/experiments/robustness.h"
#include "bench/experiments/speed.h"
#include "bench/experiments/surfaces.h"
#include "bench/experiments/timing_experiments.h"
#include "bench/experiments/visibility_cost.h"

namespace ccdt::experiments {
namespace {

using Measure = std::function<ExperimentResult(const ExperimentOptions&, bench::Runner&)>;

/// The description of a study of quality.
Measure study(const std::function<StudyPlan(const ExperimentOptions&)>& plan) {
  return [plan](const ExperimentOptions& options, bench::Runner& runner) {
    return measure_study(options, runner, plan(options));
  };
}

Measure quality(const std::string& name, const std::vector<std::string>& models) {
  return study([=](const ExperimentOptions& options) { return mesher_quality_plan(options, name, models); });
}

/// The quality of one of the paper's models; the user cannot choose models then.
Measure quality_figure(const std::string& name, const std::string& model) {
  return [name, model](const ExperimentOptions& options, bench::Runner& runner) {
    ExperimentOptions own = options;
    own.inputs.clear();
    return quality(name, {model})(own, runner);
  };
}

/// Gives the result the usual names of the experiment. Says which times spread too much.
void add_uncertainty(const std::set<std::string>& names, ExperimentResult& result) {
  constexpr std::size_t most_named = 5;
  if (names.empty()) return;
  std::vector<std::string> some(names.begin(), names.end());
  some.resize(std::min(some.size(), most_named));
  const std::string more = names.size() > some.size() ? "; ..." : "";
  add_problem(result,
              "the times of " + with_separators(names.size()) +
                  " cases spread more than requested: " + joined(some, "; ") + more,
              false);
}

Measure named(const KnownExperiment& known) {
  return [known](const ExperimentOptions& options, bench::Runner& runner) {
    Circumstances how = start_experiment(options, options.runs);
    ExperimentResult result = known.measure(options, runner);
    if (result.how.runs > 0) how.runs = result.how.runs;
    if (result.how.scale.empty()) result.how = how;
    result.name = known.name;
    result.title = known.title;
    result.section = known.section;
    add_uncertainty(runner.uncertain_cases(), result);
    return result;
  };
}

std::vector<KnownExperiment> all_experiments() {
  const std::string quality_words = "tetrahedra compared with other meshers', at equal numbers";
  std::vector<KnownExperiment> all = {
      {"table1", "Table 1: the CDT with and without the face protection check", "6, Table 1",
       "Delaunay, the CDT with and without the check, and other meshers", true, true, measure_table1},
      {"fig7", "Fig. 7: the meshes of the three models", "6, Fig. 7", "pictures of the meshes, cut open", true, false,
       measure_fig7},
      {"fig8", "Fig. 8: time against size", "6, Fig. 8", "time against size over two decades, and how it grows", true,
       true, measure_fig8},
      {"fig9", "Fig. 9: quality of the piston's tetrahedra", "6, Fig. 9", "the piston's " + quality_words, true, true,
       quality_figure("fig9", "piston")},
      {"fig10", "Fig. 10: quality of the bracket's tetrahedra", "6, Fig. 10", "the bracket's " + quality_words, true,
       true, quality_figure("fig10", "bracket")},
      {"fig11", "Fig. 11: quality of the stepping pole's tetrahedra", "6, Fig. 11",
       "the stepping pole's " + quality_words, true, true, quality_figure("fig11", "stepping-pole")},
      {"lattices", "Lattices: is FCC the best?", "3",
       "the unit cells of the 14 Bravais lattices; meshes with FCC, BCC and SC", true, true,
       study([](const auto&) { return lattices_plan(); })},
      {"locators", "Locators: which one finds the front's vertices and occluders fastest", "4",
       "grid, octree and cavity on even and on graded surfaces", true, false, measure_locators},
      {"delaunay", "Delaunay: insertion and wrapping beside CGAL and TetGen", "5",
       "the Delaunay tetrahedralization of the same points by four programs", true, false, measure_delaunay},
      {"improvement", "Improvement: the effect of swaps, smoothing and both", "5", "swaps only, smoothing only, both",
       true, false, study([](const auto&) { return improvement_plan(); })},
      {"theorem1", "Theorem 1: protected if and only if there is a DT", "5.2, Theorem 1",
       "Theorem 1 in both directions, by exhaustive search on small inputs", true, true, measure_theorem1},
      {"termination", "Termination: does splitting at midpoints terminate?", "2",
       "midpoints and shells where segments meet at small angles", true, true, measure_termination},
      {"interior-points", "Interior points: do they never harm existence?", "3",
       "whether interior points can destroy a CDT, which the paper denies", true, true, measure_interior_points},
      {"conforming", "Conforming: does CCDT need fewer vertices?", "1",
       "Steiner vertices beside a conforming Delaunay tetrahedralization", true, true, measure_conforming},
      {"conditions", "Conditions: is Theorem 1's weaker than Radovitzky and Ortiz'?", "5.2",
       "for how many models a Delaunay tetrahedralization contains the surface", true, true, measure_conditions},
      {"visibility-cost", "Visibility: is it the most expensive part of the CDT?", "5",
       "the share of the visibility tests in the instructions of the CDT without the check", true, true,
       measure_visibility_cost},
      {"min-sphere", "Smallest spheres: do they avoid slivers?", "3",
       "slivers at the surface with and without the rule for lattice points", true, true, measure_min_sphere},
      {"density", "Density: is the front linear only where it is uniform?", "1, 4, 6",
       "how the work of the front grows at uniform and at graded density", true, true, measure_density},
      {"quality", "Quality: our tetrahedra beside those of other meshers", "6",
       "all three models and your files, compared with other meshers", false, false,
       quality("quality", names_of_paper_models())},
      {"speed", "Speed: how fast, on how many threads, and at what quality", "6",
       "seconds, memory and quality beside other meshers, and scaling with threads", false, false, measure_speed},
      {"robustness", "Robustness: which real parts does each mesher mesh?", "2, 6",
       "how each mesher ends on every part of a corpus (--corpus)", false, false, measure_robustness},
      {"lattice-fit", "Lattice fit: how near to the surface should lattice points be?", "3",
       "many settings of --sphere-factor and --clearance", false, false,
       study([](const auto&) { return lattice_fit_plan(); })},
  };
  for (KnownExperiment& known : all) known.measure = named(known);
  return all;
}

}  // namespace

std::span<const KnownExperiment> known_experiments() {
  static const std::vector<KnownExperiment> all = all_experiments();
  return all;
}

}  // namespace ccdt::experiments
