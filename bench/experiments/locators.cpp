#include <optional>

#include "bench/experiments/surfaces.h"
#include "bench/experiments/timing_experiments.h"
#include "bench/run/surface_measures.h"
#include "engine/io/plc_files.h"

namespace ccdt::experiments {
namespace {

constexpr std::array locators = {LocatorKind::grid, LocatorKind::octree, LocatorKind::cavity};

/// One of our solids.
struct LocatorsModel {
  std::string name;
  double edge_length;  ///< for about 20,000 vertices
  SurfaceKind kind;
};
const std::vector<LocatorsModel> locators_models = {{"piston", 2.3, SurfaceKind::uniform},
                                                    {"bracket", 1.8, SurfaceKind::uniform},
                                                    {"stepping-pole", 1.8, SurfaceKind::uniform},
                                                    {"graded-cube", 0.0625, SurfaceKind::graded},
                                                    {"rough-sphere", 0.06, SurfaceKind::rough}};

const std::vector<std::string> locators_definitions = {
    "Seconds of the front alone, including the construction of the locator.",
    "Check off: every face goes through the front. Check on: only faces that are not Delaunay do.",
    "Uniform: our models of the paper's parts with interior vertices at the density of the surface.",
    "Graded: a cube with squares on its faces that shrink toward a corner.",
    "Rough: a sphere with uneven radii, so that some faces are not Delaunay.",
    "Edge ratio: the longest edge of the surface over the shortest.",
    "A ratio is the median of the ratios in rounds. A claim holds if the whole interval is on the right side of 1."};

using LocatorsGroup = std::span<const LocatorsRow>;  ///< grid, octree, cavity

/// A locator compared with the first of its group.
struct LocatorsRatioRow : LocatorsRow {
  std::string title;
  Estimate value;
  LocatorsGroup group;
};
std::vector<std::string> runs_of(const LocatorsRatioRow& row) {
  return all_runs_of(row.group);
}

std::string check_words(const LocatorsRow& row) {
  return row.face_protection ? "on" : "off";
}

RowColumns<LocatorsRow> columns_of_surface(const RowColumns<LocatorsRow>& more) {
  RowColumns<LocatorsRow> columns = {{label_column("model"), &LocatorsRow::name},
                                     {label_column("kind"), [](const LocatorsRow& row) { return name_of(row.kind); }},
                                     {label_column("face_protection", "check"), check_words}};
  append(columns, more);
  return columns;
}

const RowColumns<LocatorsRow> front_columns =
    columns_of_surface({{label_column("locator"), [](const LocatorsRow& row) { return name_of(row.locator); }},
                        status_column(),
                        seconds_column(),
                        count_column("front_tetrahedra", &MeshCounts::front_tetrahedra, "tetrahedra of the front"),
                        reason_column()});

const RowColumns<LocatorsRow> locators_size_columns = columns_of_surface(
    {{figure_column("edge_ratio", "longest edge over shortest"), &LocatorsRow::edge_ratio},
     count_column("vertices", &MeshCounts::vertices),
     count_column("faces", &MeshCounts::faces),
     count_column("undelaunay_faces", &MeshCounts::undelaunay_faces, "faces that are not Delaunay")});

RowColumns<LocatorsRatioRow> locators_ratio_columns() {
  RowColumns<LocatorsRatioRow> columns;
  for (const RowColumn<LocatorsRow>& column : columns_of_surface({})) columns.emplace_back(column);
  append(columns, RowColumns<LocatorsRatioRow>{{label_column("ratio"), &LocatorsRatioRow::title},
                                               {time_column("value", "here"), &LocatorsRatioRow::value}});
  return columns;
}

/// The expectation for octree and grid: on a graded surface the octree is faster, on a uniform one the grid.
std::optional<std::string> finding_of(const LocatorsRow& row, const Estimate& octree_over_grid) {
  const bool is_graded = row.kind == SurfaceKind::graded;
  if (!is_graded && row.kind != SurfaceKind::uniform) return {};
  const BoundTest test = is_graded ? is_at_most(octree_over_grid, 1) : is_at_least(octree_over_grid, 1);
  return row.name + ": that the " + (is_graded ? "octree is faster than the grid" : "grid is faster than the octree") +
         " where edges " + (is_graded ? "differ by a factor of " + rounded(row.edge_ratio) : "are even") + ": " +
         choose(test, "holds", "undecided", "does not hold") + " (octree / grid " + with_interval(octree_over_grid) +
         ")";
}

void add_group(const ExperimentOptions& options, const SurfaceFile& surface, SurfaceKind kind, bool face_protection,
               std::vector<LocatorsRow>& rows) {
  LocatorsRow row{{{}, stage_seconds(Stage::front)},
                  surface.name,
                  kind,
                  face_protection,
                  bench::edge_ratio(io::read_plc(surface.file))};
  const std::string check = check_words(row), name = surface.name + ", check " + check;
  for (const LocatorKind locator : locators) {
    row.locator = locator;
    std::string words =
        "--improve none --steiner keep --locator " + std::string(name_of(locator)) + " --face-protection " + check;
    if (kind == SurfaceKind::uniform) words += " --grading 0";
    const bench::Case single =
        single_case(options, name + ", " + std::string(name_of(locator)), "ccdt", surface.file, words_of(words));
    row.measured.asked = timed_case(options, "locators " + name, single, usual_precision, row.seconds);
    rows.push_back(row);
  }
}

std::vector<LocatorsRow> plan(const ExperimentOptions& options) {
  std::vector<LocatorsRow> rows;
  const auto add = [&](const SurfaceFile& surface, SurfaceKind kind) {
    add_group(options, surface, kind, false, rows);
    if (kind == SurfaceKind::rough || kind == SurfaceKind::input) add_group(options, surface, kind, true, rows);
  };
  for (const LocatorsModel& model : locators_models)
    if (is_chosen(options, model.name))
      add(write_solid(options, "locators", model.name, model.edge_length), model.kind);
  for (const SurfaceFile& input : input_files(options)) add(input, SurfaceKind::input);
  return rows;
}

}  // namespace

ExperimentResult locators_result(std::span<const LocatorsRow> rows) {
  ExperimentResult result{.definitions = locators_definitions};
  std::vector<LocatorsRow> firsts;
  std::vector<LocatorsRatioRow> ratios;
  const auto is_same_group = [](const LocatorsRow& a, const LocatorsRow& b) {
    return a.name == b.name && a.face_protection == b.face_protection;
  };
  for (const LocatorsGroup group : neighbors(rows, is_same_group)) {
    firsts.push_back(group.front());
    for (const LocatorsRow& row : group.subspan(1)) {
      const auto ratio = ratio_of(row, group.front());
      if (!ratio) continue;
      ratios.push_back({row, std::string(name_of(row.locator)) + " / grid", *ratio, group});
      const auto finding = row.locator == LocatorKind::octree ? finding_of(row, *ratio) : std::nullopt;
      if (finding) result.findings.push_back(*finding);
    }
  }
  for (const LocatorsRow& row : rows) add_problem_of(row, result);
  result.tables = {table_of_rows("front", "Seconds of the front", front_columns, rows),
                   table_of_rows("ratios", "Compared with the paper's grid", locators_ratio_columns(), ratios),
                   table_of_rows("sizes", "The surfaces", locators_size_columns, firsts)};
  return result;
}

ExperimentResult measure_locators(const ExperimentOptions& options, bench::Runner& runner) {
  std::vector<LocatorsRow> rows = plan(options);
  check_something_is_measured(rows.size(), "locators");
  measure_rows(runner, rows);
  ExperimentResult result = locators_result(rows);
  result.definitions.push_back(repetition_words(options));
  return result;
}

}  // namespace ccdt::experiments
