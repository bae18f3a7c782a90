#include "bench/verify/verify.h"

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/plc/warped_facets.h"
#include "python/src/bindings.h"
#include "python/src/callbacks.h"

namespace ccdt::python {
namespace {

namespace py = pybind11;

/// \throw InputError  the enumeration has no such name
template <NamedEnum Enum>
Enum chosen(const std::string& option, const std::string& name) {
  std::string names;
  for (const auto& value : names_of(Enum{})) names += " " + std::string(value.name);
  if (const auto value = value_of<Enum>(name)) return *value;
  throw ccdt::InputError(option + " cannot be '" + name + "'", {}, "choose one of" + names);
}

py::dict verify_mesh(const plc::InputPlc& input, const mesh::TetMesh& mesh, double flatness,
                     const std::string& constrained_delaunay, const std::string& surface, std::optional<double> within,
                     const std::string& boundary, const std::string& periodic, const std::string& lists,
                     unsigned threads, py::object progress) {
  verify::VerifyOptions options{.flatness = flatness};
  options.delaunay = chosen<verify::VerifyOptions::Delaunay>("constrained_delaunay", constrained_delaunay);
  options.boundary = chosen<verify::VerifyOptions::Boundary>("boundary", boundary);
  options.surface = chosen<verify::VerifyOptions::Surface>("surface", surface);
  options.periodic = chosen<plc::Periodicity>("periodic", periodic);
  options.lists = chosen<verify::VerifyOptions::Lists>("lists", lists);
  options.within = within;
  if (within) options.surface = verify::VerifyOptions::Surface::own;
  const Progress reporter = progress_of(std::move(progress));
  const verify::Verification found = [&] {
    const py::gil_scoped_release released;
    return with_threads(threads, [&] {
      const auto flat = plc::triangulate_warped_facets(input);
      return verify::verify(flat ? *flat : input, mesh, options, reporter);
    });
  }();
  py::list checks;
  for (const verify::Check& check : found.checks)
    checks.append(
        py::make_tuple(check.name, check.checked, check.failed, check.required, check.examples, check.not_compared));
  py::dict dict;
  dict["checks"] = checks;
  dict["mesh_volume"] = found.mesh_volume, dict["input_volume"] = found.input_volume;
  dict["to_input"] = found.distances ? py::cast(found.distances->to_input) : py::none();
  dict["from_input"] = found.distances ? py::cast(found.distances->from_input) : py::none();
  return dict;
}

}  // namespace
}  // namespace ccdt::python

PYBIND11_MODULE(_verify, module) {
  ccdt::python::bind_errors(module);
  module.def("verify", ccdt::python::verify_mesh);
}
