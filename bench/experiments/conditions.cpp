#include <algorithm>
#include <array>
#include <functional>

#include "bench/experiments/conforming/smallest_spheres.h"
#include "bench/experiments/existence_experiments.h"
#include "bench/experiments/surfaces.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/front/find_delaunay_faces.h"
#include "engine/io/plc_files.h"
#include "engine/plc/build_plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::experiments {
namespace {

constexpr std::array conditions_coarsenings = {3.0, 2.0, 1.0};  ///< of a solid's usual edge length
constexpr std::array conditions_lattices = {Lattice::none, Lattice::fcc};

using conforming::SphereContent;

std::vector<std::string> conditions_definitions() {
  return {
      "Radovitzky and Ortiz (2000), in the paper's section 5.2: all minimal circumspheres of the boundary are empty.",
      "The paper says that it is so strict that few bodies fulfill it without transformations and subdivision.",
      "Minimal circumsphere: the smallest sphere through the three corners; its center is in their plane.",
      "Empty: no vertex is strictly inside, decided exactly.",
      "Vertices on the sphere are allowed; regular grids have them, and the models without any are counted too.",
      "Theorem 1: all faces are Delaunay, and so are all grazeable segments.",
      "Vertices: those of the input, and with FCC the interior points that ccdt places; no Steiner vertices.",
      "Interior points keep out of the smallest ball around each face, as split by ccdt.",
      "Around an obtuse face, that is smaller than the minimal circumsphere: such points may add violations.",
      "Faces: the constrained Delaunay triangulation of each facet; others of a flat facet have larger spheres.",
      "A face with nothing in or on its minimal circumsphere is Delaunay; every case is checked for that.",
      "Both conditions are tested on the engine's grid, after rounding by less than 2.4e-10 of the box.",
  };
}

ResultTable cases_table(std::span<const ConditionsRow> rows) {
  const auto figure = [](std::string name, std::string title, auto value) {
    return RowColumn<ConditionsRow>(
        figure_column(std::move(name), std::move(title)),
        [value](const ConditionsRow& row) { return row.ok() ? as_cell(std::invoke(value, row)) : Cell(); });
  };
  const RowColumns<ConditionsRow> columns = {
      {label_column("model"), &ConditionsRow::model},
      {label_column("edge_length"),
       [](const ConditionsRow& row) { return row.edge_length > 0 ? rounded(row.edge_length) : ""; }},
      {label_column("lattice"), [](const ConditionsRow& row) { return name_of(row.lattice); }},
      status_column(),
      figure("faces", "faces", &ConditionsRow::faces),
      figure("occupied", "not empty (Radovitzky and Ortiz)", &ConditionsRow::occupied),
      figure("touched", "empty, with a vertex on it", &ConditionsRow::touched),
      figure("undelaunay", "not Delaunay (Theorem 1)", &ConditionsRow::undelaunay),
      figure("missing_edges", "missing grazeable segments", &ConditionsRow::missing_edges),
      figure("theirs", "Radovitzky and Ortiz", &ConditionsRow::fulfills_theirs),
      figure("theorem", "Theorem 1", &ConditionsRow::fulfills_theorem),
      reason_column()};
  return table_of_rows("cases", "The cases", columns, rows);
}

/// How many models fulfill which condition, with a lattice or with all.
void add_shares(std::span<const ConditionsRow> rows, std::optional<Lattice> lattice, ResultTable& table) {
  std::uint64_t count = 0, theirs = 0, strictly = 0, theorem = 0, only_theirs = 0, only_theorem = 0;
  std::vector<std::string> runs;
  for (const ConditionsRow& row : rows) {
    if (!row.ok() || (lattice && row.lattice != *lattice)) continue;
    ++count;
    append(runs, runs_of(row));
    theirs += row.fulfills_theirs() ? 1 : 0;
    strictly += row.occupied + row.touched == 0 ? 1 : 0;
    theorem += row.fulfills_theorem() ? 1 : 0;
    only_theirs += row.fulfills_theirs() && !row.fulfills_theorem() ? 1 : 0;
    only_theorem += row.fulfills_theorem() && !row.fulfills_theirs() ? 1 : 0;
  }
  if (count > 0)
    add_row(table, runs, lattice ? std::string(name_of(*lattice)) : "all", count, theirs, strictly, theorem,
            only_theirs, only_theorem);
}

ResultTable models_table(std::span<const ConditionsRow> rows) {
  ResultTable table = table_of(
      "models", "Models that fulfill the conditions",
      {label_column("lattice"), figure_column("models", "models and sizes"),
       figure_column("theirs", "Radovitzky and Ortiz"),
       figure_column("strictly", "of these, with no vertex on a sphere"), figure_column("theorem", "Theorem 1"),
       figure_column("only_theirs", "only Radovitzky and Ortiz"), figure_column("only_theorem", "only Theorem 1")});
  for (const Lattice lattice : conditions_lattices) add_shares(rows, lattice, table);
  add_shares(rows, {}, table);
  return table;
}

std::string finding_of_conditions(const RowView& row) {
  const std::uint64_t models = row.count("models");
  return "Lattice " + row.text("lattice") + ": of " + with_separators(models) + " models, " +
         with_separators(row.count("theirs")) + " fulfill the condition of Radovitzky and Ortiz (" +
         with_separators(row.count("strictly")) + " with no vertex on a sphere), " +
         with_separators(row.count("theorem")) + " that of Theorem 1; " + with_separators(row.count("only_theirs")) +
         " fulfill the first alone";
}

/// Does the engine's report say the same? It adds Steiner vertices before it counts, so only without them.
bool agrees(const ConditionsRow& row) {
  const MeshCounts& counts = row.measured.first.counts;
  if (row.lattice == Lattice::none && (counts.steiner_vertices > 0) != (row.missing_edges > 0)) return false;
  return counts.steiner_vertices > 0 || counts.undelaunay_faces == row.undelaunay;
}

void add_contradictions(const ConditionsRow& row, ExperimentResult& result) {
  if (!row.ok()) return add_problem_of(row, result);
  if (row.contradictions > 0)
    add_problem(result, row.measured.asked.name + ": " + with_separators(row.contradictions) +
                            " faces with empty smallest spheres are not Delaunay");
  if (!agrees(row))
    add_problem(result, row.measured.asked.name + ": the report of the run counts other faces or segments");
}

/// The interior vertices of the mesh of a run, in grid units: they are the last ones.
std::vector<Point3> interior_points(const mesh::TetMesh& mesh, std::size_t count, const DyadicGrid& grid) {
  std::vector<Point3> points;
  for (std::size_t v = mesh.vertices.size() - count; v < mesh.vertices.size(); ++v) {
    const Point3 p = (1 / grid.unit) * (mesh.vertices[v] - grid.origin);
    points.push_back({round_to_unit(p.x), round_to_unit(p.y), round_to_unit(p.z)});
  }
  return points;
}

void examine(const bench::Runner& runner, ConditionsRow& row) {
  if (!row.ok()) return;
  const plc::Plc plc = plc::build_plc(io::read_plc(row.measured.asked.input));
  std::vector<Point3> interior;
  if (row.lattice != Lattice::none)
    interior =
        interior_points(results::mesh_of(runner, row.measured), row.measured.first.counts.interior_vertices, plc.grid);
  count_violations(plc, interior, row);
}

}  // namespace

void count_violations(const plc::Plc& plc, std::span<const Point3> interior, ConditionsRow& row) {
  std::vector<Point3> points = plc.vertices;
  points.insert(points.end(), interior.begin(), interior.end());
  const delaunay::Delaunay delaunay = delaunay::build_delaunay(points);
  const facets::FacetMesh mesh = facets::triangulate_facets(plc, protection::SegmentChains(plc.segments), delaunay);
  const std::vector<std::uint32_t> codes = front::find_delaunay_faces(mesh.triangles, delaunay);
  const std::vector<SphereContent> contents = conforming::contents_of_smallest_spheres(mesh.triangles, points);
  row.faces = mesh.triangles.size();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const bool is_delaunay = codes[i] != delaunay::no_neighbor;
    row.occupied += contents[i] == SphereContent::vertices ? 1 : 0;
    row.touched += contents[i] == SphereContent::touching ? 1 : 0;
    row.undelaunay += is_delaunay ? 0 : 1;
    row.contradictions += !is_delaunay && contents[i] == SphereContent::nothing ? 1 : 0;
  }
  for (const plc::Segment& s : plc.segments)
    row.missing_edges += s.grazeable && !delaunay::has_edge(delaunay, s.ends[0], s.ends[1]) ? 1 : 0;
}

ExperimentResult conditions_result(std::span<const ConditionsRow> rows) {
  const ResultTable models = models_table(rows);
  ExperimentResult result{
      .how = once(), .definitions = conditions_definitions(), .tables = {models, cases_table(rows)}};
  for (const RowView& row : rows_with(models)) result.findings.push_back(finding_of_conditions(row));
  for (const ConditionsRow& row : rows) add_contradictions(row, result);
  return result;
}

ExperimentResult measure_conditions(const ExperimentOptions& options, bench::Runner& runner) {
  std::vector<SurfaceFile> files = write_solids(options, "conditions", conditions_coarsenings);
  append(files, parts_that_come_along(options));
  append(files, input_files(options));
  check_something_is_measured(files.size(), "conditions");
  std::vector<ConditionsRow> rows;
  for (const SurfaceFile& file : files)
    for (const Lattice lattice : conditions_lattices) {
      const std::string name(name_of(lattice)), at = file.edge_length > 0 ? " at " + rounded(file.edge_length) : "";
      ConditionsRow& row = rows.emplace_back();
      row.model = file.name, row.edge_length = file.edge_length, row.lattice = lattice;
      row.measured.asked = single_case(options, joined({file.name + at, name}), "ccdt", file.file,
                                       {"--lattice", name, "--improve", "none", "--steiner", "keep"});
      if (lattice != Lattice::none) row.measured.asked.mesh_ending = ".vtu";
    }
  measure_rows(runner, rows);
  for (ConditionsRow& row : rows) examine(runner, row);
  return conditions_result(rows);
}

}  // namespace ccdt::experiments
