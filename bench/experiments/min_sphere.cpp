#include "bench/experiments/min_sphere.h"

#include <algorithm>
#include <array>
#include <vector>

#include "bench/experiments/surfaces.h"
#include "bench/run/quality.h"
#include "engine/geometry/tetrahedron_shape.h"

namespace ccdt::experiments {
namespace {

const std::vector<std::string> min_sphere_definitions = {
    "Sphere rule: no lattice point is in the smallest sphere of a face, as in the paper (--sphere-factor 1; off: 0).",
    "Clearance rule, ours: no lattice point is nearer to the surface than 0.55 edge lengths (--clearance; off: 0.01).",
    "FCC lattice with the edge length of the surface, unimproved. The claim is about the sphere rule alone.",
    "At the surface: tetrahedra with a vertex on the boundary or an interior facet.",
    "Slivers: a dihedral angle below 5 degrees. The table also has other limits: 10 degrees, and r above 5.",
    "With an interior vertex: other slivers have all vertices on the surface, which no rule for the lattice moves."};

std::string on_or_off(bool rule) {
  return rule ? "on" : "off";
}

/// A figure of the slivers; empty if the run failed.
template <class Figure>
RowColumn<MinSphereRow> figure_of(Column column, Figure figure) {
  return {std::move(column),
          [figure](const MinSphereRow& row) { return row.slivers ? as_cell(figure(*row.slivers)) : Cell(); }};
}

RowColumn<MinSphereRow> per_thousand(const char* name, const char* title, std::uint64_t SurfaceSlivers::*count) {
  return figure_of(figure_column(name, title), [count](const SurfaceSlivers& s) { return s.per_thousand(s.*count); });
}

const RowColumns<MinSphereRow> min_sphere_columns = {
    {label_column("model"), &MinSphereRow::model},
    {label_column("sphere_rule"), [](const MinSphereRow& row) { return on_or_off(row.sphere_rule); }},
    {label_column("clearance_rule"), [](const MinSphereRow& row) { return on_or_off(row.clearance_rule); }},
    status_column(),
    count_column("interior_vertices", &MeshCounts::interior_vertices),
    count_column("tetrahedra", &MeshCounts::tetrahedra),
    figure_of(figure_column("at_surface", "tetrahedra at the surface"),
              [](const SurfaceSlivers& s) { return s.tetrahedra; }),
    figure_of(figure_column("slivers", "slivers at the surface"),
              [](const SurfaceSlivers& s) { return s.below_5_degrees; }),
    per_thousand("slivers_per_1000", "per 1,000 tetrahedra at the surface", &SurfaceSlivers::below_5_degrees),
    per_thousand("with_interior_vertex_per_1000", "of these, with an interior vertex",
                 &SurfaceSlivers::with_interior_vertex),
    per_thousand("below_10_degrees_per_1000", "below 10 degrees, per 1,000", &SurfaceSlivers::below_10_degrees),
    per_thousand("large_r_per_1000", "r above 5, per 1,000", &SurfaceSlivers::with_large_r),
    figure_of(figure_column("smallest_dihedral", "", "degrees"),
              [](const SurfaceSlivers& s) { return s.smallest_dihedral; }),
    figure_of(figure_column("worst_r"), [](const SurfaceSlivers& s) { return s.worst_r; }),
    reason_column()};

/// The four combinations of rules on a surface.
void plan_surface(const ExperimentOptions& options, const SurfaceFile& surface, std::vector<MinSphereRow>& rows) {
  for (const bool clearance : {false, true})
    for (const bool sphere : {false, true}) {
      MinSphereRow& row = rows.emplace_back();
      row.model = surface.name, row.sphere_rule = sphere, row.clearance_rule = clearance;
      std::string words = "--improve none --lattice fcc --grading 0 --sphere-factor ";
      words += std::string(sphere ? "1" : "0") + " --clearance " + (clearance ? "0.55" : "0.01");
      row.measured.asked = single_case(
          options, surface.name + ", sphere rule " + on_or_off(sphere) + ", clearance rule " + on_or_off(clearance),
          "ccdt", surface.file, words_of(words));
      row.measured.asked.mesh_ending = ".vtu";
    }
}

/// The row of the sphere rule alone, and that of no rule; null if one failed.
struct SphereRuleRows {
  const MinSphereRow *with = nullptr, *without = nullptr;
};
SphereRuleRows alone_in(std::span<const MinSphereRow> model) {
  SphereRuleRows rows;
  for (const MinSphereRow& row : model)
    if (!row.clearance_rule && row.slivers) (row.sphere_rule ? rows.with : rows.without) = &row;
  return rows;
}

}  // namespace

SurfaceSlivers slivers_at_surface(const mesh::TetMesh& mesh) {
  constexpr double sliver = 5, nearly = 10, large_r = 5;  // degrees, degrees, 1
  std::vector<bool> is_on_surface(mesh.vertices.size());
  for (const auto& face : mesh.faces)
    for (const std::uint32_t vertex : face) is_on_surface[vertex] = true;
  SurfaceSlivers slivers;
  for (const auto& corners : mesh.tetrahedra) {
    const auto on_surface = std::ranges::count_if(corners, [&](std::uint32_t v) { return is_on_surface[v]; });
    if (on_surface == 0) continue;
    const std::array<Point3, 4> points = {mesh.vertices[corners[0]], mesh.vertices[corners[1]],
                                          mesh.vertices[corners[2]], mesh.vertices[corners[3]]};
    const double dihedral = std::ranges::min(dihedral_angles(points)), r = shape_measure(points);
    ++slivers.tetrahedra;
    slivers.below_5_degrees += dihedral < sliver;
    slivers.below_10_degrees += dihedral < nearly;
    slivers.with_large_r += r > large_r;
    slivers.with_interior_vertex += dihedral < sliver && on_surface < 4;
    slivers.smallest_dihedral = std::min(slivers.smallest_dihedral, dihedral);
    slivers.worst_r = std::max(slivers.worst_r, r);
  }
  return slivers;
}

ExperimentResult min_sphere_result(std::span<const MinSphereRow> rows) {
  ExperimentResult result{.how = once(), .definitions = min_sphere_definitions};
  for (const std::span<const MinSphereRow> model :
       neighbors(rows, [](const MinSphereRow&a, const MinSphereRow&b) { return a.model == b.model; })) {
    const auto [with, without] = alone_in(model);
    if (with == nullptr || without == nullptr) continue;
    const auto share = [](const MinSphereRow& row) {
      return rounded(row.slivers->per_thousand(row.slivers->below_5_degrees));
    };
    result.findings.push_back(model.front().model + ": of 1,000 tetrahedra at the surface, " + share(*with) +
                              " are slivers with the sphere rule alone, and " + share(*without) + " without any rule");
  }
  result.tables = {table_of_rows("slivers", "Slivers at the surface", min_sphere_columns, rows)};
  for (const MinSphereRow& row : rows) add_problem_of(row, result);
  return result;
}

ExperimentResult measure_min_sphere(const ExperimentOptions& options, bench::Runner& runner) {
  std::vector<MinSphereRow> rows;
  for (const PaperModel& model : paper_models)
    if (is_chosen(options, model.name))
      plan_surface(options, write_solid(options, "min-sphere", model.name, model.edge_length), rows);
  for (const SurfaceFile& input : input_files(options)) plan_surface(options, input, rows);
  check_something_is_measured(rows.size(), "min-sphere");
  measure_rows(runner, rows);
  for (MinSphereRow& row : rows)
    if (row.ok()) row.slivers = slivers_at_surface(results::mesh_of(runner, row.measured));
  return min_sphere_result(rows);
}

}  // namespace ccdt::experiments
