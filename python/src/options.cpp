#include <pybind11/stl.h>

#include <string>
#include <utility>

#include "engine/io/read_sizes.h"
#include "engine/options/set_option.h"
#include "python/src/arrays.h"
#include "python/src/bindings.h"
#include "python/src/callbacks.h"

namespace ccdt::python {
namespace {

/// What Python code needs to know about an option, to document it and to refuse other names.
py::dict described(const options::MeshOption& option) {
  static const MeshOptions defaults;
  py::dict description;
  description["name"] = option.name;
  description["what"] = option.what;
  description["default"] = option.usual ? py::object(py::none()) : py::cast(options::recorded_value(option, defaults));
  py::dict choices;
  if (const auto* choice = std::get_if<options::ChoiceKind>(&option.kind))
    for (const auto& [name, what] : choice->names) choices[py::str(name.data(), name.size())] = what;
  description["choices"] = choices;
  description["is_file"] = std::holds_alternative<options::FileKind>(option.kind);
  return description;
}

py::list option_table() {
  py::list table;
  for (const options::MeshOption& option : options::mesh_options()) table.append(described(option));
  return table;
}

Point3 point_of(const std::array<double, 3>& p) {
  return {p[0], p[1], p[2]};
}

using Corner = std::array<double, 3>;

/// An entry of a size field. The names of arguments are those of the schema ccdt.sizefield/1.
void add_size(MeshOptions& options, double edge_length, double volume, double within, std::vector<int> markers,
              std::vector<std::string> names, std::vector<int> segments, std::vector<int> regions,
              const std::vector<std::pair<Corner, Corner>>& boxes,
              const std::vector<std::pair<Corner, double>>& balls) {
  LocalSize size;
  size.edge_length = edge_length, size.volume = volume, size.within = within;
  size.markers = std::move(markers), size.names = std::move(names);
  size.segments = std::move(segments), size.regions = std::move(regions);
  for (const auto& [low, high] : boxes) size.boxes.push_back({point_of(low), point_of(high)});
  for (const auto& [center, radius] : balls) size.balls.push_back({point_of(center), radius});
  options.local.sizes.push_back(std::move(size));
}

void set_background(MeshOptions& options, const Array<double>& vertices, const Array<std::uint32_t>& tetrahedra,
                    const Array<double>& sizes) {
  options.background = {"", "", vector_of<Point3>(vertices), vector_of<std::array<std::uint32_t, 4>>(tetrahedra),
                        vector_of<double>(sizes)};
}

}  // namespace

void bind_options(py::module_& module) {
  module.def("option_table", option_table);
  py::class_<MeshOptions>(module, "Options")
      .def(py::init<>())
      .def("set", [](MeshOptions& options, const std::string& name,
                     const std::string& value) { options::set_option(name, value, options); })
      .def("read_background",
           [](MeshOptions& options, const std::string& file) { options.background = io::read_sizes(file); })
      .def("set_background", set_background)
      .def("set_field_name", [](MeshOptions& options, const std::string& file) { options.local.name = file; })
      .def("set_function", [](MeshOptions& options,
                              py::object function) { options.local.function = size_function_of(std::move(function)); })
      .def("add_size", add_size, py::kw_only(), py::arg("edge_length") = 0, py::arg("volume") = 0,
           py::arg("within") = 0, py::arg("markers") = std::vector<int>(),
           py::arg("names") = std::vector<std::string>(), py::arg("segments") = std::vector<int>(),
           py::arg("regions") = std::vector<int>(), py::arg("boxes") = std::vector<std::pair<Corner, Corner>>(),
           py::arg("balls") = std::vector<std::pair<Corner, double>>());
}

}  // namespace ccdt::python
