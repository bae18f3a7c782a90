#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "engine/include/ccdt/ccdt.h"
#include "engine/plc/warped_facets.h"
#include "python/src/bindings.h"
#include "python/src/callbacks.h"

namespace ccdt::python {
namespace {

namespace py = pybind11;

/// Runs the engine without the GIL, which its threads take when they call Python.
template <class Run>
auto without_gil(const Run& run) {
  const py::gil_scoped_release released;
  return run();
}

py::dict dict_of(const improve::ImproveCounts& counts) {
  py::dict dict;
  dict["bad_tetrahedra"] = counts.bad_cells;
  dict["bad_tetrahedra_left"] = counts.bad_cells_left;
  dict["inserted_vertices"] = counts.inserted_vertices;
  dict["collapsed_edges"] = counts.collapsed_edges;
  dict["stopped_by"] = name_of(counts.stop);
  return dict;
}

py::dict dict_of(const MeshCounts& counts) {
  py::dict dict;
  dict["vertices"] = counts.vertices;
  dict["steiner_vertices"] = counts.steiner_vertices;
  dict["interior_vertices"] = counts.interior_vertices;
  dict["tetrahedra"] = counts.tetrahedra;
  dict["faces"] = counts.faces;
  dict["undelaunay_faces"] = counts.undelaunay_faces;
  dict["front_tetrahedra"] = counts.front_tetrahedra;
  return dict;
}

py::dict dict_of(const StageCosts& costs) {
  py::dict dict;
  for (const NamedValue<Stage>& stage : names_of(Stage{}))
    dict[py::str(stage.name.data(), stage.name.size())] = costs[stage.value].seconds;
  dict["mesh"] = costs.mesh_seconds;
  return dict;
}

py::tuple mesh(const InputPlc& input, const MeshOptions& options, py::object progress) {
  const Progress reporter = progress_of(std::move(progress));
  MeshResult result = without_gil([&] { return mesh_plc(input, options, reporter); });
  return py::make_tuple(std::move(result.mesh), dict_of(result.counts), dict_of(result.costs));
}

py::tuple improve(TetMesh mesh, const MeshOptions& options, py::object progress) {
  const Progress reporter = progress_of(std::move(progress));
  ImprovedMesh improved =
      without_gil([&] { return improve_tet_mesh(std::move(mesh), options.improve, options.threads, reporter); });
  return py::make_tuple(std::move(improved.mesh), dict_of(improved.counts));
}

InputPlc remesh(const InputPlc& input, const MeshOptions& options, py::object progress) {
  const Progress reporter = progress_of(std::move(progress));
  return without_gil([&] {
    const auto flat = plc::triangulate_warped_facets(input);
    return remesh_surface(flat ? *flat : input, remesh_options_of(options), reporter);
  });
}

py::list list_of(const std::vector<Place>& places) {
  const py::object type = py::module_::import("ccdt.errors").attr("Place");
  py::list list;
  for (const Place& place : places) list.append(type(place.file, place.line, place.byte, place.points, place.facets));
  return list;
}

py::dict check(const InputPlc& input, double flatness, py::object progress) {
  const Progress reporter = progress_of(std::move(progress));
  const repair::Diagnosis diagnosis = without_gil([&] { return find_faults(input, flatness, reporter); });
  py::dict dict;
  dict["vertices"] = diagnosis.vertices, dict["facets"] = diagnosis.facets, dict["segments"] = diagnosis.segments;
  dict["regions"] = diagnosis.regions, dict["volume"] = diagnosis.volume, dict["is_valid"] = diagnosis.is_valid();
  py::list faults;
  for (const repair::Fault& fault : diagnosis.faults) {
    std::string_view what;
    for (const auto& kind : names_of(repair::FaultKind{}))
      if (kind.value == fault.kind) what = kind.what;
    faults.append(py::make_tuple(name_of(fault.kind), what, fault.is_error, fault.count, fault.at_least, fault.detail,
                                 list_of(fault.places)));
  }
  dict["faults"] = faults;
  return dict;
}

py::dict dict_of(const repair::Certificate& certificate) {
  py::dict dict;
  dict["displacement"] = certificate.displacement;
  dict["area_before"] = certificate.area_before, dict["area_after"] = certificate.area_after;
  dict["area_of_lids"] = certificate.area_of_lids, dict["area_removed"] = certificate.area_removed;
  dict["largest_lid"] = certificate.largest_lid, dict["farthest_lid"] = certificate.farthest_lid;
  dict["volume_before"] = certificate.volume_before;
  dict["components_before"] = certificate.components_before, dict["components_after"] = certificate.components_after;
  dict["genus"] = certificate.genus;
  return dict;
}

py::dict repair_surface(const InputPlc& input, double flatness, double gap, double limit, double seconds,
                        py::object progress) {
  const Progress reporter = progress_of(std::move(progress));
  repair::Repaired repaired = without_gil([&] {
    return repair_input(input, {.flatness = flatness, .gap = gap, .limit = limit, .seconds = seconds}, reporter);
  });
  py::dict dict;
  py::list steps;
  for (const repair::RepairStep& step : repaired.steps)
    steps.append(py::make_tuple(step.name, step.what, step.count, list_of(step.places)));
  dict["steps"] = steps, dict["certificate"] = dict_of(repaired.certificate);
  dict["refused"] = repaired.refused, dict["is_out_of_time"] = repaired.is_out_of_time;
  dict["surface"] = std::move(repaired.input);
  return dict;
}

}  // namespace

void bind_functions(py::module_& module) {
  module.attr("usual_flatness") = usual_flatness;
  module.def("mesh", mesh);
  module.def("improve", improve);
  module.def("remesh", remesh);
  module.def("check", check);
  module.def("repair", repair_surface);
  module.def("read_plc", [](const std::string& file) { return without_gil([&] { return read_plc(file); }); });
  module.def("read_tet_mesh", [](const std::string& file) { return without_gil([&] { return read_tet_mesh(file); }); });
  module.def("write_plc",
             [](const InputPlc& input, const std::string& file) { without_gil([&] { write_plc(input, file); }); });
  module.def("write_tet_mesh", [](const TetMesh& mesh, const std::string& file, const std::string& format, int order) {
    without_gil([&] { write_tet_mesh(mesh, file, format, order); });
  });
}

}  // namespace ccdt::python
