#include <algorithm>
#include <optional>

#include "bench/experiments/surfaces.h"
#include "bench/experiments/timing_experiments.h"
#include "engine/io/plc_files.h"
#include "models/solids.h"

namespace ccdt::experiments {
namespace {

/// The paper's measurements of a model (Table 1; Pentium IV, 2.0 GHz).
struct PaperTimes {
  std::string model;
  double delaunay = 0, with_check = 0, without_check = 0;
};
const std::vector<PaperTimes> paper_times = {
    {"piston", 25.53, 26.01, 602.25}, {"bracket", 33.14, 34.26, 607.15}, {"stepping-pole", 35.83, 37.14, 610.94}};

/// A way to mesh a model.
struct Way {
  enum class Input { surface, our_vertices, surface_and_our_interior_vertices };
  std::string name, mesher, words;
  Input input = Input::surface;
};
const std::vector<Way> table1_ways = {
    {"with_check", "ccdt", "--strategies paper --improve none --steiner keep --face-protection on"},
    {"without_check", "ccdt", "--strategies paper --improve none --steiner keep --face-protection off"},
    {"default_with_check", "ccdt", "--improve none --steiner keep --face-protection on"},
    {"searched", "ccdt", "--improve none --steiner keep --face-protection off --locator grid"},
    {"looked_up", "ccdt", "--improve none --steiner keep --face-protection off"},
    {"cgal_delaunay", "cgal-delaunay", "", Way::Input::our_vertices},
    {"tetgen_cdt", "tetgen", "--lattice none", Way::Input::surface_and_our_interior_vertices},
    {"tetgen_quality", "tetgen", ""},
    {"mesh3", "cgal-mesh3", "--improve none"}};

/// Seconds of a way: a row of the table of times.
struct Timed {
  std::string what, way;
  bench::SecondsOf seconds = whole_seconds;
  double PaperTimes::*in_paper = nullptr;
};
const std::string delaunay = "Delaunay", with_check = "CDT with face protection check", without_check = "CDT without",
                  default_delaunay = "default: Delaunay", default_with_check = "default: CDT with check",
                  searched = "default: every apex searched for", looked_up = "default: every apex looked up",
                  cgal = "CGAL Delaunay, same vertices", tetgen = "TetGen CDT, same vertices";
const std::vector<Timed> all_timed = {{delaunay, "with_check", stage_seconds(Stage::delaunay), &PaperTimes::delaunay},
                                      {with_check, "with_check", cdt_seconds, &PaperTimes::with_check},
                                      {without_check, "without_check", cdt_seconds, &PaperTimes::without_check},
                                      {default_delaunay, "default_with_check", stage_seconds(Stage::delaunay)},
                                      {default_with_check, "default_with_check", cdt_seconds},
                                      {searched, "searched", cdt_seconds},
                                      {looked_up, "looked_up", cdt_seconds},
                                      {"default: whole mesh", "default_with_check"},
                                      {cgal, "cgal_delaunay"},
                                      {tetgen, "tetgen_cdt"},
                                      {"TetGen, its own vertices", "tetgen_quality"},
                                      {"CGAL Mesh_3, its own vertices", "mesh3"}};

/// A ratio: what is divided by what.
struct Ratio {
  std::string title, above, below;
};
const std::vector<Ratio> all_ratios = {{"with check / Delaunay", with_check, delaunay},
                                       {"without check / Delaunay", without_check, delaunay},
                                       {"without / with check", without_check, with_check},
                                       {"default: with check / Delaunay", default_with_check, default_delaunay},
                                       {"default: searched / with check", searched, default_with_check},
                                       {"default: looked up / with check", looked_up, default_with_check},
                                       {"paper's / default, with check", with_check, default_with_check},
                                       {"default: Delaunay / CGAL Delaunay", default_delaunay, cgal},
                                       {"default: with check / TetGen CDT", default_with_check, tetgen}};

const std::vector<std::string> table1_definitions = {
    "The models are ours: the paper gives neither the geometry nor the sizes of its three parts.",
    "The first three rows are the paper's algorithm (--strategies paper); the verdicts are about these.",
    "It is Delaunay face by face in a uniform grid, a front in the same grid, its visibility tests, and midpoints.",
    "Default: the engine as it is used. All ways make the same tetrahedra.",
    "Delaunay: the Delaunay stage of the run with the check, on all vertices of the mesh.",
    "CDT: the stages delaunay, face_check, front and label of a run. It keeps all Steiner vertices.",
    "Without the check, every face goes through the front.",
    "Searched: the front searches for each apex, with the engine's own test of visibility, in the paper's grid.",
    "Looked up: for a face that is Delaunay, the front copies the apex from the finished tetrahedralization.",
    "That is a look-up and no search, so this row is no ablation.",
    "Not included in CDT times: facets, the constrained Delaunay triangulation of each facet, once before the lattice.",
    "Also not included: finish, which restores the units of the coordinates and checks the result.",
    "with check / Delaunay is computed within each run; the other ratios are ratios of medians.",
    "Work: exact counts of what the Delaunay stage and the front did.",
    "CGAL Delaunay, same vertices: all vertices of our mesh.",
    "TetGen CDT, same vertices: switch p, the input with our interior vertices.",
    "Its own vertices: refined to the edge length of the surface, by TetGen with pYq1.414a, which keeps the surface.",
    "Mesh_3 replaces the surface. It only refines: these times contain no improvement of any mesher.",
    "For other meshers, only the call of the library is timed.",
    "Mesh_3 takes part from 50,000 tetrahedra on (--scale full): because of small features, it cannot make fewer."};

struct TimedRow : CaseRow {
  std::string model;
  Timed timed;
  std::optional<double> paper_seconds;
};
const RowColumns<TimedRow> table1_time_columns = {
    {label_column("model"), &TimedRow::model},
    {label_column("what", "what is timed"), [](const TimedRow& row) { return row.timed.what; }},
    status_column(),
    seconds_column(),
    {column(ColumnKind::paper, "paper_seconds", "in the paper", "s"), &TimedRow::paper_seconds},
    count_column("vertices", &MeshCounts::vertices),
    count_column("tetrahedra", &MeshCounts::tetrahedra),
    reason_column()};

struct Table1RatioRow {
  std::string model, title;
  Estimate value;
  std::optional<double> paper;
  std::vector<TimedRow> of;  ///< above, below
};
std::vector<std::string> runs_of(const Table1RatioRow& row) {
  return all_runs_of(row.of);
}
const RowColumns<Table1RatioRow> table1_ratio_columns = {
    {label_column("model"), &Table1RatioRow::model},
    {label_column("ratio"), &Table1RatioRow::title},
    {time_column("value", "here"), &Table1RatioRow::value},
    {column(ColumnKind::paper, "paper_value", "in the paper"), &Table1RatioRow::paper}};

/// Of the run with the check.
struct ModelRow : CaseRow {
  std::string model;
  double edge_length = 0;
  bench::MeasuredCase without_check;

  bool both_ok() const { return ok() && !without_check.failed(); }
  bool is_same_mesh() const { return measured.first.mesh_fingerprint == without_check.first.mesh_fingerprint; }
};
const RowColumns<ModelRow> table1_size_columns = {
    {label_column("model"), &ModelRow::model},
    {figure_column("edge_length", "", "mm"), &ModelRow::edge_length},
    count_column("vertices", &MeshCounts::vertices),
    count_column("steiner_vertices", &MeshCounts::steiner_vertices, "Steiner vertices"),
    count_column("interior_vertices", &MeshCounts::interior_vertices),
    count_column("tetrahedra", &MeshCounts::tetrahedra),
    count_column("faces", &MeshCounts::faces),
    count_column("undelaunay_faces", &MeshCounts::undelaunay_faces, "faces that are not Delaunay"),
    {figure_column("same_tetrahedra", "same tetrahedra without the check"),
     [](const ModelRow& row) { return cell_if(row.both_ok(), row.is_same_mesh()); }}};

/// What a run did, per vertex of the Delaunay stage and per tetrahedron of the front.
struct WorkRow : CaseRow {
  std::string model, way;

  double per(Stage stage, std::uint64_t Work::*count, std::uint64_t MeshCounts::*unit) const {
    const RunRecord& run = measured.first;
    return static_cast<double>(run.costs[stage].work.*count) / static_cast<double>(run.counts.*unit);
  }
};

RowColumn<WorkRow> delaunay_column(const char* name, const char* title, std::uint64_t Work::*count) {
  return {figure_column(name, title),
          [count](const WorkRow& row) { return row.per(Stage::delaunay, count, &MeshCounts::vertices); }};
}
/// Empty if the front did nothing.
RowColumn<WorkRow> front_column(const char* name, const char* title, std::uint64_t Work::*count) {
  return {figure_column(name, title), [count](const WorkRow& row) {
            return cell_if(row.measured.first.counts.front_tetrahedra > 0,
                           row.per(Stage::front, count, &MeshCounts::front_tetrahedra));
          }};
}
const RowColumns<WorkRow> work_columns = {
    {label_column("model"), &WorkRow::model},
    {label_column("way"), &WorkRow::way},
    delaunay_column("vertices_examined", "Delaunay: vertices examined, per vertex", &Work::vertices_examined),
    delaunay_column("delaunay_grid_cells", "Delaunay: grid cells, per vertex", &Work::grid_cells),
    delaunay_column("cells_created", "Delaunay: cells created, per vertex", &Work::cells_created),
    count_column("front_tetrahedra", &MeshCounts::front_tetrahedra, "tetrahedra of the front"),
    front_column("candidates", "front: candidates, per tetrahedron", &Work::front_candidates),
    front_column("visibility_tests", "front: visibility tests, per tetrahedron", &Work::visibility_tests),
    front_column("grid_cells", "front: grid cells, per tetrahedron", &Work::grid_cells)};

std::vector<WorkRow> work_rows(const Table1Model& model) {
  std::vector<WorkRow> rows;
  for (const Way& way : table1_ways) {
    const auto measured = model.cases.find(way.name);
    if (way.mesher == "ccdt" && measured != model.cases.end() && !measured->second.failed())
      rows.push_back({{measured->second}, model.name, way.name});
  }
  return rows;
}

/// Median microseconds per vertex or tetrahedron.
double cost(const bench::MeasuredCase& measured, const bench::SecondsOf& seconds, std::uint64_t MeshCounts::*unit) {
  return 1e6 * bench::median(samples_of(measured, seconds)) / static_cast<double>(measured.first.counts.*unit);
}
double delaunay_cost(const ModelRow& row) {
  return cost(row.measured, stage_seconds(Stage::delaunay), &MeshCounts::vertices);
}
double check_cost(const ModelRow& row) {
  const auto check = [](const StageCosts& costs) { return cdt_seconds(costs) - costs[Stage::delaunay].seconds; };
  return cost(row.measured, check, &MeshCounts::vertices);
}
double front_cost(const ModelRow& row) {  // without the check, the front builds every tetrahedron
  return cost(row.without_check, stage_seconds(Stage::front), &MeshCounts::front_tetrahedra);
}
const RowColumns<ModelRow> cost_columns = {
    {label_column("model"), &ModelRow::model},
    {time_column("delaunay", "Delaunay, per vertex", "us"), delaunay_cost},
    {time_column("check", "face check, front and labels, per vertex", "us"), check_cost},
    {time_column("front", "front without the check, per tetrahedron", "us"), front_cost}};

std::vector<TimedRow> timed_rows(const Table1Model& model) {
  std::vector<TimedRow> rows;
  const auto paper = std::ranges::find(paper_times, model.name, &PaperTimes::model);
  for (const Timed& timed : all_timed) {
    const auto measured = model.cases.find(timed.way);
    if (measured == model.cases.end()) continue;
    rows.push_back({{measured->second, timed.seconds}, model.name, timed, {}});
    if (timed.in_paper && paper != paper_times.end()) rows.back().paper_seconds = (*paper).*timed.in_paper;
  }
  return rows;
}

/// The median of the ratios within each run if both times come from it, otherwise of those in each round.
std::optional<Estimate> divided(const TimedRow& above, const TimedRow& below) {
  if (above.timed.way != below.timed.way) return ratio_of(above, below);
  if (!above.ok()) return {};
  const auto in_a_run = [&](const StageCosts& costs) { return above.seconds(costs) / below.seconds(costs); };
  return median_of(above.measured, in_a_run);
}

std::vector<Table1RatioRow> ratio_rows(const std::vector<TimedRow>& rows) {
  std::vector<Table1RatioRow> ratios;
  const auto row_of = [&](const std::string& what) {
    return std::ranges::find_if(rows, [&](const TimedRow& row) { return row.timed.what == what; });
  };
  for (const Ratio& ratio : all_ratios) {
    const auto above = row_of(ratio.above), below = row_of(ratio.below);
    if (above == rows.end() || below == rows.end()) continue;
    const auto value = divided(*above, *below);
    if (!value) continue;
    ratios.push_back({above->model, ratio.title, *value, {}, {*above, *below}});
    if (above->paper_seconds && below->paper_seconds)
      ratios.back().paper = *above->paper_seconds / *below->paper_seconds;
  }
  return ratios;
}

/// Says how much more the front would have to do, or how much faster Delaunay would have to be, for the paper's factor.
void add_missing_work(const ModelRow& row, const Table1RatioRow& saving, std::vector<std::string>& lines) {
  const double vertices = static_cast<double>(row.measured.first.counts.vertices),
               tetrahedra = static_cast<double>(row.without_check.first.counts.front_tetrahedra);
  const double delaunay_us = delaunay_cost(row), front_us = front_cost(row);
  const double with_us = vertices * (delaunay_us + check_cost(row));
  const double needed_us = (*saving.paper * with_us - vertices * delaunay_us) / tetrahedra;
  const Work& work = row.without_check.first.costs[Stage::front].work;
  const auto per = [&](std::uint64_t count) { return rounded(static_cast<double>(count) / tetrahedra); };
  lines.push_back(row.model + ": without the check, the front takes " + rounded(front_us) +
                  " microseconds per tetrahedron, for " + per(work.front_candidates) + " candidates, " +
                  per(work.visibility_tests) + " faces tested for visibility and " + per(work.grid_cells) +
                  " grid cells. The paper's factor of " + rounded(*saving.paper) + " would need " +
                  rounded(needed_us / front_us) + " times as much of that, or a Delaunay stage and a check that are " +
                  "that many times faster: they take " + rounded(with_us / vertices) + " microseconds per vertex");
}

/// Compares our ratios with the paper's.
void add_differences(const ModelRow& row, const std::vector<Table1RatioRow>& ratios, std::vector<std::string>& lines) {
  const std::string who = row.model + ": ";
  for (const Table1RatioRow& ratio : ratios) {
    if (!ratio.paper) continue;
    if (ratio.title == all_ratios[0].title)
      lines.push_back(who + "with the check, the CDT takes " + with_interval(ratio.value) +
                      " times as long as Delaunay (paper: " + rounded(*ratio.paper, 4) + "): " +
                      choose(is_at_most(ratio.value, *ratio.paper), "not more than in the paper.",
                             "these runs cannot tell it from the paper's.", "more than in the paper."));
    if (ratio.title == all_ratios[2].title) {
      lines.push_back(who + "without the check, the CDT takes " + with_interval(ratio.value) +
                      " times as long as with it (paper: " + rounded(*ratio.paper, 4) +
                      "): " + choose(is_at_least(ratio.value, least_gain), "at least ", "not surely ", "less than ") +
                      rounded(least_gain, 1) + ".");
      if (row.both_ok()) add_missing_work(row, ratio, lines);
    }
  }
}

/// The model with the interior vertices of our mesh, for meshers that tetrahedralize the same vertices and facets.
void write_with_interior_vertices(InputPlc plc, const bench::Runner& runner, const bench::MeasuredCase& ours,
                                  const std::filesystem::path& file) {
  const TetMesh mesh = mesh_of(runner, ours);
  const auto interior = static_cast<std::ptrdiff_t>(ours.first.counts.interior_vertices);
  plc.vertices.insert(plc.vertices.end(), mesh.vertices.end() - interior, mesh.vertices.end());
  io::write_plc(plc, file);
}

Table1Model measure_model(const ExperimentOptions& options, const PaperModel& model, bench::Runner& runner) {
  Table1Model result{model.name, model.edge_length * edge_factor(options)};
  const auto file = [&](const char* rest) { return options.folder / "models" / (result.name + rest); };
  const auto surface = file(".poly"), with_interior_vertices = file("-with-interior-vertices.poly");
  const InputPlc plc = models::make_solid(result.name, result.edge_length);
  io::write_plc(plc, surface);
  std::vector<bench::Case> asked;
  std::filesystem::path vertices;
  for (const Way& way : table1_ways) {
    if (!is_timed(options, way.mesher)) continue;
    const auto& input = way.input == Way::Input::surface        ? surface
                        : way.input == Way::Input::our_vertices ? vertices
                                                                : with_interior_vertices;
    bench::Case single = single_case(options, result.name + ", " + way.name, way.mesher, input, words_of(way.words));
    if (asked.empty()) {  // ours; others take its vertices
      single.mesh_ending = ".node";
      const bench::MeasuredCase ours = runner.run(single);
      vertices = options.folder / mesh_file(ours);
      if (!ours.failed()) write_with_interior_vertices(plc, runner, ours, with_interior_vertices);
    }
    const auto seconds = way.mesher == "ccdt" ? cdt_seconds : whole_seconds;
    asked.push_back(timed_case(options, "table1 " + result.name, single, usual_precision, seconds));
  }
  const std::vector<bench::MeasuredCase> measured = runner.run(asked);
  for (std::size_t i = 0, next = 0; i < table1_ways.size(); ++i)
    if (is_timed(options, table1_ways[i].mesher)) result.cases[table1_ways[i].name] = measured[next++];
  return result;
}

}  // namespace

ExperimentResult table1_result(std::span<const Table1Model> models) {
  ExperimentResult result{.definitions = table1_definitions};
  std::vector<TimedRow> times;
  std::vector<Table1RatioRow> ratios;
  std::vector<ModelRow> sizes, costs;
  std::vector<WorkRow> work;
  for (const Table1Model& model : models) {
    const std::vector<TimedRow> rows = timed_rows(model);
    const std::vector<Table1RatioRow> of_model = ratio_rows(rows);
    const ModelRow& size = sizes.emplace_back(
        ModelRow{{model.cases.at("with_check")}, model.name, model.edge_length, model.cases.at("without_check")});
    if (size.both_ok()) costs.push_back(size);
    append(times, rows);
    append(ratios, of_model);
    append(work, work_rows(model));
    add_differences(size, of_model, result.findings);
    for (const auto& [way, measured] : model.cases) add_problem_of({measured}, result);
    if (size.both_ok() && !size.is_same_mesh())
      add_problem(result, model.name + ": the tetrahedra differ with and without the check, which is an error of ccdt");
  }
  result.tables = {table_of_rows("ratios", "Ratios", table1_ratio_columns, ratios),
                   table_of_rows("times", "Seconds", table1_time_columns, times),
                   table_of_rows("work", "Work", work_columns, work),
                   table_of_rows("sizes", "The meshes", table1_size_columns, sizes),
                   table_of_rows("costs", "Cost per unit of work", cost_columns, costs)};
  return result;
}

ExperimentResult measure_table1(const ExperimentOptions& options, bench::Runner& runner) {
  std::vector<Table1Model> models;
  for (const PaperModel& model : paper_models)
    if (is_chosen(options, model.name)) models.push_back(measure_model(options, model, runner));
  check_something_is_measured(models.size(), "table1");
  ExperimentResult result = table1_result(models);
  result.definitions.push_back(repetition_words(options));
  return result;
}

}  // namespace ccdt::experiments
