#include "bench/experiments/surfaces.h"
#include "bench/experiments/timing_experiments.h"
#include "engine/io/plc_files.h"

namespace ccdt::experiments {
namespace {

constexpr std::array all_locators = {LocatorKind::grid, LocatorKind::octree, LocatorKind::cavity};

/// A solid of ours.
struct LocatorsModel {
  const char* name;
  double edge_length;  ///< for about 20,000 vertices
  SurfaceKind kind;
};
constexpr std::array<LocatorsModel, 5> models = {{{"piston", 2.3, SurfaceKind::uniform},
                                                  {"bracket", 1.8, SurfaceKind::uniform},
                                                  {"stepping-pole", 1.8, SurfaceKind::uniform},
                                                  {"graded-cube", 0.0625, SurfaceKind::graded},
                                                  {"rough-sphere", 0.06, SurfaceKind::rough}}};

/// A surface with or without the check, before and after its runs.
struct LocatorsGroup {
  LocatorsCase result;
  std::vector<MeasuredCase> cases;  ///< one a locator
};

LocatorsGroup group_of(const ExperimentOptions& options, const SurfaceFile& surface, SurfaceKind kind,
                       bool face_protection, std::size_t number) {
  LocatorsGroup group;
  group.result = {surface.name, kind, face_protection, bench::edge_ratio(io::read_plc(surface.file))};
  const std::string check = face_protection ? "on" : "off";
  for (const LocatorKind locator : all_locators) {
    const std::string name(name_of(locator));
    const std::string surface_stem = std::filesystem::path(surface.name).stem().string();
    const std::string stem = joined({"locators", std::to_string(number), surface_stem, check, name}, "-");
    std::vector<std::string> words = {"--improve", "none", "--locator", name, "--face-protection", check};
    if (kind == SurfaceKind::uniform) words.insert(words.end(), {"--grading", "0"});
    group.cases.push_back({name, stem, {"ccdt", surface.file, options.folder / "meshes" / "locators.vtu", words}});
  }
  return group;
}

std::vector<LocatorsGroup> plan(const ExperimentOptions& options) {
  std::vector<LocatorsGroup> groups;
  const auto add = [&](const SurfaceFile& surface, SurfaceKind kind) {
    groups.push_back(group_of(options, surface, kind, false, groups.size()));
    if (kind == SurfaceKind::rough || kind == SurfaceKind::input)
      groups.push_back(group_of(options, surface, kind, true, groups.size()));
  };
  for (const LocatorsModel& model : models)
    if (is_asked_for(options, model.name))
      add(write_solid(options, "locators", model.name, model.edge_length), model.kind);
  for (const SurfaceFile& input : input_files(options)) add(input, SurfaceKind::input);
  return groups;
}

LocatorsCase evaluate(const LocatorsGroup& group) {
  LocatorsCase result = group.result;
  for (std::size_t i = 0; i < all_locators.size(); ++i) {
    result.rows.push_back({outcome_of(group.cases[i], &StageSeconds::front), all_locators[i]});
    if (result.rows.back().ok()) result.counts = result.rows.back().counts;
  }
  const auto over_grid = [&](const LocatorsRow& row) -> std::optional<Estimate> {
    const LocatorsRow& grid = result.rows[0];
    if (!row.seconds || !grid.seconds || bench::quantile(grid.samples, 0) <= 0) return {};
    return bench::ratio_of_medians(row.samples, grid.samples);
  };
  result.octree_over_grid = over_grid(result.rows[1]);
  result.cavity_over_grid = over_grid(result.rows[2]);
  return result;
}

std::vector<std::string> definitions() {
  return {
      "Seconds of the front alone; the locators' structures are built within it.",
      "Check off: every face goes through the front. Check on: only the faces that are not Delaunay do.",
      "Uniform: the paper's models with interior vertices at the density of the surface.",
      "Graded: a cube with squares on its faces that shrink towards a corner.",
      "Rough: a sphere with uneven radii, so that some faces are not Delaunay.",
      "Edge ratio: the longest edge of the surface over the shortest.",
      "Ratios are of medians. A claim holds if the whole interval is on its side of 1.",
  };
}

std::string check_words(const LocatorsCase& c) {
  return c.face_protection ? "on" : "off";
}

ResultTable case_table(std::string name, std::string title, const std::vector<Column>& more) {
  ResultTable table = table_of(std::move(name), std::move(title),
                               {label_column("model"), label_column("kind"), label_column("face_protection", "check")});
  append(table.columns, more);
  return table;
}

std::vector<ResultTable> tables_of(const Locators& locators) {
  ResultTable front = case_table("front", "Seconds of the front",
                                 {label_column("locator"), label_column("status"), time_column("seconds", "", "s"),
                                  figure_column("front_tetrahedra", "tetrahedra of the front"), note_column("reason")});
  ResultTable ratios =
      case_table("ratios", "Beside the paper's grid", {label_column("ratio"), time_column("value", "here")});
  ResultTable sizes =
      case_table("sizes", "The surfaces",
                 {figure_column("edge_ratio", "longest edge over shortest"), figure_column("vertices"),
                  figure_column("faces"), figure_column("undelaunay_faces", "faces that are not Delaunay")});
  for (const LocatorsCase& c : locators.cases) {
    const auto add = [&](ResultTable& table, const std::vector<std::string>& runs, const auto&... values) {
      add_row(table, runs, c.name, name_of(c.kind), check_words(c), values...);
    };
    std::vector<std::string> runs;
    for (const LocatorsRow& row : c.rows) {
      add(front, row.runs, name_of(row.locator), name_of(row.status), row.seconds, c.counts.front_tetrahedra,
          row.reason);
      append(runs, row.runs);
    }
    if (c.octree_over_grid) add(ratios, runs, "octree / grid", c.octree_over_grid);
    if (c.cavity_over_grid) add(ratios, runs, "cavity / grid", c.cavity_over_grid);
    add(sizes, c.rows.empty() ? runs : c.rows.front().runs, c.edge_ratio, c.counts.vertices, c.counts.faces,
        c.counts.undelaunay_faces);
  }
  return {front, ratios, sizes};
}

std::vector<std::string> findings_of(const Locators& locators) {
  std::vector<std::string> lines;
  for (const LocatorsCase& c : locators.cases) {
    const auto claim = expectation(c);
    if (!claim) continue;
    const bool is_graded = c.kind == SurfaceKind::graded;
    lines.push_back(c.name + ": that the " +
                    (is_graded ? "octree is faster than the grid" : "grid is faster than the octree") +
                    " where edges " + (is_graded ? "differ by a factor of " + rounded(c.edge_ratio) : "are even") +
                    ": " + choose(*claim, "holds", "undecided", "does not hold") + " (octree / grid " +
                    with_interval(*c.octree_over_grid) + ")");
  }
  return lines;
}

}  // namespace

std::optional<BoundTest> expectation(const LocatorsCase& locators) {
  if (!locators.octree_over_grid) return {};
  if (locators.kind == SurfaceKind::graded) return is_at_most(*locators.octree_over_grid, 1);
  if (locators.kind == SurfaceKind::uniform) return is_at_least(*locators.octree_over_grid, 1);
  return {};
}

Locators measure_locators(const ExperimentOptions& options, const Progress& progress) {
  Locators locators{start_experiment(options, options.runs), {}};
  std::vector<LocatorsGroup> groups = plan(options);
  check_something_is_measured(groups.size(), "locators");
  StepCounter steps(progress, groups.size() * all_locators.size() * static_cast<std::uint64_t>(options.runs + 1));
  for (LocatorsGroup& group : groups) {
    run_in_turn(options, group.cases, 0, [&](const MeasuredCase& measured, int) { steps.next(measured.stem); });
    locators.cases.push_back(evaluate(group));
  }
  std::filesystem::remove(options.folder / "meshes" / "locators.vtu");
  return locators;
}

ExperimentResult result_of(const Locators& locators) {
  ExperimentResult result{.how = locators.how,
                          .definitions = definitions(),
                          .tables = tables_of(locators),
                          .findings = findings_of(locators)};
  for (const LocatorsCase& c : locators.cases)
    for (const LocatorsRow& row : c.rows) {
      if (row.ok()) continue;
      const std::string locator(name_of(row.locator));
      add_problem(result, c.name + ", check " + check_words(c) + ", " + locator + ": " + row.failure());
    }
  return result;
}

}  // namespace ccdt::experiments
