#include <algorithm>
#include <array>

#include "bench/experiments/surfaces.h"
#include "bench/experiments/timing_experiments.h"
#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"
#include "models/solids.h"

namespace ccdt::experiments {
namespace {

/// What the paper measured on a model (Table 1; Pentium IV, 2.0 GHz).
struct PaperTimes {
  PaperModel model;
  double delaunay_seconds, with_check_seconds, without_check_seconds;
};

constexpr std::array<PaperTimes, 3> paper_times = {{{paper_models[0], 25.53, 26.01, 602.25},
                                                    {paper_models[1], 33.14, 34.26, 607.15},
                                                    {paper_models[2], 35.83, 37.14, 610.94}}};

/// The cases of one model, and what becomes of their files.
class ModelExperiment {
 public:
  ModelExperiment(const ExperimentOptions& options, const PaperTimes& paper)
      : options_(options), paper_(paper), edge_length_(paper.model.edge_length * edge_factor(options)) {}

  /// The cases in the order in which they take turns.
  std::vector<MeasuredCase> plan() const {
    std::vector<MeasuredCase> cases;
    const auto add = [&](const char* name, const char* mesher, const std::filesystem::path& input,
                         std::vector<std::string> more) {
      if (!is_timed(options_, mesher)) return;
      cases.push_back(
          {name, std::string(paper_.model.name) + "-" + name, {mesher, input, mesh_file(name), std::move(more)}});
    };
    add("with_check", "ccdt", surface_file(), {"--improve", "none", "--face-protection", "on"});
    add("without_check", "ccdt", surface_file(), {"--improve", "none", "--face-protection", "off"});
    add("without_check_grid", "ccdt", surface_file(),
        {"--improve", "none", "--face-protection", "off", "--locator", "grid"});
    add("cgal_delaunay", "cgal-delaunay", mesh_file("with_check"), {});
    add("tetgen_cdt", "tetgen", points_file(), {"--lattice", "none"});
    add("tetgen_quality", "tetgen", surface_file(), {});
    add("mesh3", "cgal-mesh3", surface_file(), {"--improve", "none"});
    return cases;
  }

  void write_surface() const { io::write_plc(surface(), surface_file()); }

  /// The model with the interior vertices of our mesh, for those that are to tetrahedralize the same vertices and
  /// facets.
  void write_points(const MeasuredCase& with_check) const {
    InputPlc plc = surface();
    const TetMesh mesh = io::read_tet_mesh(with_check.call.output);
    const auto interior = static_cast<std::ptrdiff_t>(with_check.first.counts.interior_vertices);
    plc.vertices.insert(plc.vertices.end(), mesh.vertices.end() - interior, mesh.vertices.end());
    io::write_plc(plc, points_file());
  }

  Table1Model evaluate(const std::vector<MeasuredCase>& cases) const;

 private:
  std::filesystem::path in_folder(const char* folder, const std::string& rest) const {
    return options_.folder / folder / (std::string(paper_.model.name) + rest);
  }
  std::filesystem::path surface_file() const { return in_folder("models", ".poly"); }
  std::filesystem::path points_file() const { return in_folder("models", "-with-interior-vertices.poly"); }
  std::filesystem::path mesh_file(const std::string& name) const { return in_folder("meshes", "-" + name + ".node"); }

  InputPlc surface() const { return models::make_solid(paper_.model.name, edge_length_); }

  bool same_tetrahedra() const {
    const auto sorted = [&](const char* name) {
      auto tetrahedra = io::read_tet_mesh(mesh_file(name)).tetrahedra;
      for (auto& t : tetrahedra) std::ranges::sort(t);
      std::ranges::sort(tetrahedra);
      return tetrahedra;
    };
    return sorted("with_check") == sorted("without_check");
  }

  const ExperimentOptions& options_;
  const PaperTimes& paper_;
  double edge_length_;
};

Table1Ratio ratio_of(const Table1Model& model, std::string id, std::string label, const char* above,
                     const char* below) {
  const auto row = [&](const char* name) { return std::ranges::find(model.rows, name, &Table1Row::id); };
  Table1Ratio ratio{std::move(id), std::move(label)};
  const auto a = row(above), b = row(below);
  if (a == model.rows.end() || b == model.rows.end()) return ratio;
  if (a->seconds && b->seconds && b->seconds->value > 0) ratio.value = bench::ratio_of_medians(a->samples, b->samples);
  ratio.runs = a->runs;
  if (b->runs != a->runs) append(ratio.runs, b->runs);
  if (a->paper_seconds && b->paper_seconds) ratio.paper = *a->paper_seconds / *b->paper_seconds;
  return ratio;
}

/// The check against the Delaunay stage of the very same run: paired, so that the machine's ups and downs cancel out.
Table1Ratio check_ratio(const MeasuredCase& with_check, const PaperTimes& paper) {
  Table1Ratio ratio{"with_check/delaunay",
                    "with check / Delaunay",
                    {},
                    paper.with_check_seconds / paper.delaunay_seconds,
                    run_files(with_check)};
  const auto in_a_run = [](const StageSeconds& s) { return cdt_seconds(s) / s.delaunay; };
  if (!with_check.failed()) ratio.value = bench::median_estimate(samples_of(with_check, in_a_run));
  return ratio;
}

Table1Costs costs_of(const MeasuredCase& with_check, const MeasuredCase& without_check) {
  const auto cost = [](const MeasuredCase& measured, const SecondsOf& seconds, std::uint64_t units) {
    return 1e6 * bench::median(samples_of(measured, seconds)) / static_cast<double>(units);
  };
  const auto check = [](const StageSeconds& s) { return cdt_seconds(s) - s.delaunay; };
  const std::uint64_t vertices = with_check.first.counts.vertices;
  return {cost(with_check, &StageSeconds::delaunay, vertices), cost(with_check, check, vertices),
          cost(without_check, &StageSeconds::front, without_check.first.counts.front_tetrahedra)};
}

Table1Model ModelExperiment::evaluate(const std::vector<MeasuredCase>& cases) const {
  Table1Model model{.name = paper_.model.name, .edge_length = edge_length_};
  const auto add = [&](const char* name, const char* id, const char* label, const SecondsOf& seconds,
                       std::optional<double> paper = {}) {
    const auto found = std::ranges::find(cases, name, &MeasuredCase::name);
    if (found != cases.end()) model.rows.push_back({outcome_of(*found, seconds), id, label, paper});
  };
  add("with_check", "delaunay", "Delaunay", &StageSeconds::delaunay, paper_.delaunay_seconds);
  add("with_check", "with_check", "CDT with face protection check", cdt_seconds, paper_.with_check_seconds);
  add("without_check", "without_check", "CDT without", cdt_seconds, paper_.without_check_seconds);
  add("without_check_grid", "without_check_grid", "CDT without, paper's grid", cdt_seconds,
      paper_.without_check_seconds);
  add("with_check", "ccdt_mesh", "ccdt, whole mesh", &StageSeconds::mesh);
  add("cgal_delaunay", "cgal_delaunay", "CGAL Delaunay, same vertices", &StageSeconds::mesh);
  add("tetgen_cdt", "tetgen_cdt", "TetGen CDT, same vertices", &StageSeconds::mesh);
  add("tetgen_quality", "tetgen_quality", "TetGen, its own vertices", &StageSeconds::mesh);
  add("mesh3", "mesh3", "CGAL Mesh_3, its own vertices", &StageSeconds::mesh);

  model.ratios = {check_ratio(cases[0], paper_),
                  ratio_of(model, "without_check/delaunay", "without check / Delaunay", "without_check", "delaunay"),
                  ratio_of(model, "without_check_grid/delaunay", "without check, paper's grid / Delaunay",
                           "without_check_grid", "delaunay"),
                  ratio_of(model, "without_check/with_check", "without / with check", "without_check", "with_check"),
                  ratio_of(model, "delaunay/cgal_delaunay", "Delaunay / CGAL Delaunay", "delaunay", "cgal_delaunay"),
                  ratio_of(model, "with_check/tetgen_cdt", "with check / TetGen CDT", "with_check", "tetgen_cdt")};
  if (!cases[0].failed() && !cases[1].failed()) {
    model.same_tetrahedra = same_tetrahedra();
    model.costs = costs_of(cases[0], cases[1]);
  }
  return model;
}

std::vector<std::string> definitions() {
  return {
      "Delaunay: the Delaunay stage of the run with the check, on all vertices of the mesh.",
      "CDT: the stages delaunay, face_check, front and label of a run.",
      "Without the check, every face goes through the front.",
      "Not in the CDT times: facets, the constrained Delaunay triangulation of each facet, once before the lattice.",
      "Nor in them: finish, which gives the coordinates their units back and checks the result.",
      "Paper's grid: the front finds its vertices with the uniform grid of the paper's section 4 (--locator grid).",
      "All other strategies are the default ones; the records of the runs have them.",
      "with check / Delaunay is taken within each run; the other ratios are of medians.",
      "CGAL Delaunay, same vertices: all vertices of our mesh.",
      "TetGen CDT, same vertices: switch p, the input with our interior vertices.",
      "Its own vertices: refined to the edge length of the surface, by TetGen with pYq1.414a, which keeps the surface.",
      "Mesh_3 replaces the surface. It refines alone: nobody's improvement is in these times.",
      "Meshers other than ours are timed by the call of the library alone.",
      "Mesh_3 takes part from 50,000 tetrahedra on (--scale paper): small features of the models keep it from fewer.",
      "What takes long has at most three counted runs.",
  };
}

std::vector<ResultTable> tables_of(const Table1& table) {
  ResultTable ratios = table_of("ratios", "Ratios",
                                {label_column("model"), label_column("ratio"), time_column("value", "here"),
                                 column(ColumnKind::paper, "paper_value", "in the paper")});
  ResultTable times =
      table_of("times", "Seconds",
               {label_column("model"), label_column("what", "what is timed"), label_column("status"),
                time_column("seconds", "", "s"), column(ColumnKind::paper, "paper_seconds", "in the paper", "s"),
                figure_column("vertices"), figure_column("tetrahedra"), note_column("reason")});
  ResultTable sizes = table_of("sizes", "The meshes",
                               {label_column("model"), figure_column("edge_length", "", "mm"),
                                figure_column("vertices"), figure_column("steiner_vertices", "Steiner vertices"),
                                figure_column("interior_vertices"), figure_column("tetrahedra"), figure_column("faces"),
                                figure_column("undelaunay_faces", "faces that are not Delaunay"),
                                figure_column("same_tetrahedra", "same tetrahedra without the check")});
  ResultTable costs = table_of("costs", "What a unit of work costs",
                               {label_column("model"), time_column("delaunay", "Delaunay, a vertex", "us"),
                                time_column("check", "face check, front and labels, a vertex", "us"),
                                time_column("front", "front without the check, a tetrahedron", "us")});
  for (const Table1Model& model : table.models) {
    for (const Table1Ratio& ratio : model.ratios)
      if (ratio.value) add_row(ratios, ratio.runs, model.name, ratio.label, ratio.value, ratio.paper);
    for (const Table1Row& row : model.rows)
      add_row(times, row.runs, model.name, row.label, name_of(row.status), row.seconds, row.paper_seconds,
              cell_if(row.seconds.has_value(), row.counts.vertices),
              cell_if(row.seconds.has_value(), row.counts.tetrahedra), row.reason);
    const Table1Row& row = model.rows.front();
    const MeshCounts& c = row.counts;
    add_row(sizes, row.runs, model.name, model.edge_length, c.vertices, c.steiner_vertices, c.interior_vertices,
            c.tetrahedra, c.faces, c.undelaunay_faces, model.same_tetrahedra);
    if (model.costs)
      add_row(costs, row.runs, model.name, model.costs->delaunay_per_vertex, model.costs->check_per_vertex,
              model.costs->front_per_tetrahedron);
  }
  return {ratios, times, sizes, costs};
}

const Table1Ratio* ratio(const Table1Model& model, std::string_view id) {
  const auto found = std::ranges::find(model.ratios, id, &Table1Ratio::id);
  return found != model.ratios.end() && found->value ? &*found : nullptr;
}

/// "1.21 [1.20, 1.22] times as long as Delaunay (paper: 1.019): ".
std::string times_delaunay(const Table1Ratio& ratio) {
  return with_interval(*ratio.value) + " times as long as Delaunay (paper: " + rounded(*ratio.paper, 4) + "): ";
}

std::string check_sentence(const Table1Model& model, const Table1Ratio& check) {
  return model.name + ": with the check, the CDT takes " + times_delaunay(check) +
         choose(is_at_most(*check.value, *check.paper), "not more than there.", "these runs cannot tell it from there.",
                "more than there.");
}

std::string front_sentence(const Table1Model& model, const Table1Ratio& front) {
  return model.name + ": without the check, it takes " + times_delaunay(front) +
         choose(is_at_least(*front.value, least_gain), "at least ", "not surely ", "less than ") +
         rounded(least_gain, 1) + ".";
}

std::string check_reason(const Table1Model& model) {
  const Table1Costs& costs = *model.costs;
  return model.name + ": the check is one pass over the cells, labelling another; together they take " +
         rounded(costs.check_per_vertex) +
         " microseconds a vertex. That is linear, but the Delaunay stage that it is compared with takes only " +
         rounded(costs.delaunay_per_vertex) +
         " microseconds a vertex. (The paper's Delaunay took 26 to 36 s; it does not say for how many vertices.)";
}

std::string front_reason(const Table1Model& model) {
  return model.name + ": without the check, the front finds each apex in " +
         rounded(model.costs->front_per_tetrahedron) +
         " microseconds a tetrahedron; the cheaper that is, the less there is for the check to save.";
}

/// Where our ratios differ from the paper's, and why, as measured.
void add_differences(const Table1Model& model, std::vector<std::string>& lines) {
  const Table1Ratio* check = ratio(model, "with_check/delaunay");
  const Table1Ratio* front = ratio(model, "without_check/delaunay");
  if (check != nullptr && check->paper) {
    lines.push_back(check_sentence(model, *check));
    if (model.costs && is_at_most(*check->value, *check->paper) != BoundTest::holds)
      lines.push_back(check_reason(model));
  }
  if (front != nullptr && front->paper) {
    lines.push_back(front_sentence(model, *front));
    if (model.costs && is_at_least(*front->value, *front->paper) != BoundTest::holds)
      lines.push_back(front_reason(model));
  }
}

void add_problems(const Table1Model& model, ExperimentResult& result) {
  for (const Table1Row& row : model.rows)
    if (!row.ok())
      add_problem(result, model.name + ", " + row.label + ": " + row.failure(), row.paper_seconds.has_value());
  if (!model.same_tetrahedra)
    add_problem(result, model.name + ": with and without the check, the tetrahedra differ, which is an error of ccdt");
}

}  // namespace

Table1 measure_table1(const ExperimentOptions& options, const Progress& progress) {
  Table1 table{start_experiment(options, options.runs), {}};
  const auto is_asked = [&](const PaperTimes& paper) { return is_asked_for(options, paper.model.name); };
  const auto model_count = static_cast<std::uint64_t>(std::ranges::count_if(paper_times, is_asked));
  check_something_is_measured(model_count, "table1");
  std::uint64_t done = 0;
  for (const PaperTimes& paper : paper_times) {
    if (!is_asked(paper)) continue;
    const ModelExperiment experiment(options, paper);
    experiment.write_surface();
    std::vector<MeasuredCase> cases = experiment.plan();
    const std::uint64_t total = model_count * cases.size() * static_cast<std::uint64_t>(options.runs + 1);
    run_in_turn(
        options, cases, 0,
        [&](const MeasuredCase& measured, int) {
          report(progress, std::string(paper.model.name) + " " + measured.name, done++, total);
        },
        [&](const MeasuredCase& measured, int number) {
          if (number == 0 && measured.name == "with_check" && !measured.failed()) experiment.write_points(measured);
        });
    table.models.push_back(experiment.evaluate(cases));
  }
  return table;
}

ExperimentResult result_of(const Table1& table) {
  ExperimentResult result{.how = table.how, .definitions = definitions()};
  if (table.models.empty()) return result;
  result.tables = tables_of(table);
  for (const Table1Model& model : table.models) {
    add_differences(model, result.findings);
    add_problems(model, result);
  }
  return result;
}

}  // namespace ccdt::experiments
