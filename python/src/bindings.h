#pragma once

#include <pybind11/pybind11.h>

namespace ccdt::python {

// Each adds its part to the module. The package in python/ccdt makes of it what users see.
void bind_errors(pybind11::module_& module);
void bind_options(pybind11::module_& module);
void bind_surface(pybind11::module_& module);
void bind_tet_mesh(pybind11::module_& module);
void bind_quality(pybind11::module_& module);
void bind_functions(pybind11::module_& module);

}  // namespace ccdt::python
