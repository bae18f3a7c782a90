#include <algorithm>

#include "bench/experiments/existence_experiments.h"
#include "bench/experiments/surfaces.h"

namespace ccdt::experiments {
namespace {

constexpr std::array lattices = {Lattice::fcc, Lattice::bcc, Lattice::sc};
constexpr std::array rules = {InteriorRule::paper, InteriorRule::no_spheres, InteriorRule::no_distances};
constexpr std::uint64_t tetrahedra_a_trial = 100;  ///< so many small PLCs a family are tried for the wanted tetrahedra
constexpr std::array coarsenings = {4.0, 2.0, 1.0};  ///< of a solid's usual edge length

std::vector<std::string> options_of(InteriorRule rule) {
  switch (rule) {
    case InteriorRule::paper:
      return {"--sphere-factor", "1"};
    case InteriorRule::no_spheres:
      return {"--sphere-factor", "0"};
    case InteriorRule::no_distances:
      return {"--sphere-factor", "0", "--clearance", "0.01"};
  }
  return {};
}

bool has_constrained_delaunay(const SmallPlc& plc) {
  return search_constrained_delaunay(plc).constrained_delaunay > 0;
}

InteriorCase run(const ExperimentOptions& options, const SurfaceFile& surface, Lattice lattice, InteriorRule rule,
                 std::uint64_t number) {
  std::vector<std::string> words = options_of(rule);
  append(words, std::vector<std::string>{"--improve", "none", "--lattice", std::string(name_of(lattice))});
  const std::string record = "runs/interior-points-" + std::to_string(number) + ".json";
  const RunRecord run =
      run_call(options, {"ccdt", surface.file, options.folder / "meshes" / "interior-points.vtu", words},
               options.folder / record);
  return {{run.status, run.reason, {record}, run.counts}, surface.name, surface.edge_length, lattice, rule};
}

std::vector<std::string> definitions() {
  return {
      "The paper, section 3: \"Insertion of interior points does not affect CDT existence.\" It gives no proof.",
      "Family: small random PLCs with a CDT, to which one interior point is added; existence is tested by exhaustion.",
      "Existence rests on edge protection: each grazeable edge is a chain of Delaunay edges.",
      "A point does harm, and is dropped, if with it a protected edge would be Delaunay no more.",
      "Rule paper: no point in the smallest sphere of a face or subsegment, nor near to the surface.",
      "Near: within 0.55 edge lengths.",
      "Rule no spheres: the distance alone (--sphere-factor 0).",
      "Rule no distances: neither (--sphere-factor 0 --clearance 0.01).",
      "A case is one input at one density, with one lattice and one rule.",
      "The smallest counterexample we know is a tetrahedron with a dent, five vertices, and one point below the dent.",
      "With that point it has tetrahedralizations, but no constrained Delaunay one.",
      "See engine/tests/interior_points_test.cpp.",
  };
}

std::vector<ResultTable> tables_of(const InteriorPoints& points) {
  const char* dropped_title = "points that would have destroyed a protected edge";
  ResultTable existence = table_of("existence", "Existence with one interior point more, by exhaustion",
                                   {label_column("family"), figure_column("cases", "PLCs with a CDT"),
                                    figure_column("lost", "of these without one with the point"),
                                    note_column("counterexample", "the smallest, its last vertex the point")});
  for (const ExistenceTrials& trials : points.existence)
    add_row(existence, {}, trials.family, trials.cases, trials.lost,
            cell_if(trials.lost > 0, small_plcs::in_words(trials.counterexample)));
  ResultTable rules_table = table_of(
      "rules", "What the rules let through",
      {label_column("rule"), label_column("lattice"), figure_column("cases"), figure_column("interior_vertices"),
       figure_column("dropped", dropped_title), figure_column("harmed", "cases with such points")});
  const auto add = [&](InteriorRule rule, std::string_view lattice, const InteriorSummary& s) {
    add_row(rules_table, {}, name_of(rule), lattice, s.cases, s.placed, s.dropped, s.harmed);
  };
  for (const InteriorRule rule : rules) {
    for (const Lattice lattice : lattices) add(rule, name_of(lattice), summarize(points.cases, rule, lattice));
    add(rule, "all", summarize(points.cases, rule));
  }
  ResultTable cases = table_of("cases", "The cases",
                               {label_column("model"), label_column("edge_length"), label_column("rule"),
                                label_column("lattice"), label_column("status"), figure_column("interior_vertices"),
                                figure_column("dropped", dropped_title), note_column("reason")});
  for (const InteriorCase& c : points.cases)
    add_row(cases, c.runs, c.input, c.edge_length > 0 ? rounded(c.edge_length) : "", name_of(c.rule),
            name_of(c.lattice), name_of(c.status), c.counts.interior_vertices, c.counts.dropped_interior_vertices,
            c.reason);
  return {existence, rules_table, cases};
}

std::string existence_finding(const InteriorPoints& points) {
  std::uint64_t cases = 0, lost = 0;
  for (const ExistenceTrials& trials : points.existence) {
    cases += trials.cases;
    lost += trials.lost;
  }
  return share_words(lost, cases) + " small PLCs with a CDT have none when one interior point is added";
}

std::vector<std::string> findings_of(const InteriorPoints& points) {
  std::vector<std::string> lines = {existence_finding(points)};
  for (const InteriorRule rule : rules) {
    const InteriorSummary s = summarize(points.cases, rule);
    const std::string rule_words = "Rule \"" + std::string(name_of(rule)) + "\": ";
    if (s.cases == 0)
      lines.push_back(rule_words + "no case to judge by");
    else if (s.harmed == 0)
      lines.push_back(rule_words + "no point did harm in " + with_separators(s.cases) + " cases with " +
                      with_separators(s.placed) + " interior vertices");
    else
      lines.push_back(rule_words + "points do harm: " + with_separators(s.dropped) + " points of " +
                      with_separators(s.placed + s.dropped) + " would have destroyed a protected edge, in " +
                      share_words(s.harmed, s.cases) + " cases");
  }
  return lines;
}

}  // namespace

SmallPlc with_interior_point(const SmallPlc& plc, std::uint64_t seed) {
  constexpr int most_draws = 50;
  small_plcs::Random random(seed);
  small_plcs::Point low = plc.vertices.front(), high = low;
  for (const small_plcs::Point& p : plc.vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const auto last = static_cast<small_plcs::Vertex>(plc.vertices.size());
  SmallPlc more = plc;
  more.vertices.emplace_back();
  for (int draw = 0; draw < most_draws; ++draw) {
    more.vertices.back() = {random.between(low.x, high.x), random.between(low.y, high.y),
                            random.between(low.z, high.z)};
    if (is_inside(more, {last}) && is_generic(more)) return more;
  }
  return {};
}

std::vector<ExistenceTrials> try_interior_points(std::uint64_t cases_a_family) {
  std::vector<ExistenceTrials> all;
  std::uint64_t seed = 1;
  for (const Family& family : small_plcs::families()) {
    if (family.is_cospherical) continue;
    ExistenceTrials trials{.family = std::string(family.name)};
    small_plcs::Random random(++seed);
    for (std::uint64_t i = 0; i < cases_a_family; ++i) {
      const SmallPlc plc = next_plc(family, random);
      const SmallPlc more = with_interior_point(plc, ++seed);
      if (more.vertices.empty() || !has_constrained_delaunay(plc)) continue;
      ++trials.cases;
      if (has_constrained_delaunay(more)) continue;
      const bool is_smallest = trials.lost++ == 0 || more.vertices.size() < trials.counterexample.vertices.size();
      if (is_smallest) trials.counterexample = more;
    }
    all.push_back(std::move(trials));
  }
  return all;
}

InteriorSummary summarize(std::span<const InteriorCase> cases, InteriorRule rule, std::optional<Lattice> lattice) {
  InteriorSummary summary;
  for (const InteriorCase& c : cases) {
    if (c.rule != rule || (lattice && c.lattice != *lattice)) continue;
    if (!c.ok()) {
      ++summary.failed;
      continue;
    }
    ++summary.cases;
    summary.harmed += c.counts.dropped_interior_vertices > 0;
    summary.placed += c.counts.interior_vertices;
    summary.dropped += c.counts.dropped_interior_vertices;
  }
  return summary;
}

InteriorPoints measure_interior_points(const ExperimentOptions& options, const Progress& progress) {
  InteriorPoints points{start_experiment(options, 1), {}, {}};
  std::vector<SurfaceFile> files = write_solids(options, "interior-points", coarsenings);
  append(files, input_files(options));
  check_something_is_measured(files.size(), "interior-points");
  const std::uint64_t total = files.size() * lattices.size() * rules.size();
  for (const SurfaceFile& file : files)
    for (const Lattice lattice : lattices)
      for (const InteriorRule rule : rules) {
        const std::uint64_t number = points.cases.size();
        report(progress, file.name + " " + std::string(name_of(lattice)), number, total);
        points.cases.push_back(run(options, file, lattice, rule, number));
      }
  std::filesystem::remove(options.folder / "meshes" / "interior-points.vtu");
  points.existence = try_interior_points(static_cast<std::uint64_t>(options.tetrahedra) / tetrahedra_a_trial);
  return points;
}

ExperimentResult result_of(const InteriorPoints& points) {
  ExperimentResult result{
      .how = points.how, .definitions = definitions(), .tables = tables_of(points), .findings = findings_of(points)};
  for (const InteriorCase& c : points.cases) {
    if (c.ok()) continue;
    const std::string at = c.edge_length > 0 ? " at " + rounded(c.edge_length) : "";
    add_problem(result, c.input + at + ", " + std::string(name_of(c.lattice)) + ", " + std::string(name_of(c.rule)) +
                            ": " + c.failure());
  }
  return result;
}

}  // namespace ccdt::experiments
