#include "engine/version.h"
#include "python/src/bindings.h"

PYBIND11_MODULE(_engine, module) {
  module.attr("version") = ccdt::engine_version.data();
  ccdt::python::bind_errors(module);
  ccdt::python::bind_options(module);
  ccdt::python::bind_surface(module);
  ccdt::python::bind_tet_mesh(module);
  ccdt::python::bind_quality(module);
  ccdt::python::bind_functions(module);
}
