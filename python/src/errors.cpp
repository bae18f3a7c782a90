#include "engine/base/errors.h"

#include <pybind11/stl.h>

#include <exception>

#include "python/src/bindings.h"

namespace ccdt::python {
namespace {

namespace py = pybind11;

/// Raises an exception of the module ccdt.errors.
void raise(const char* name, const Error& error) {
  const py::module_ errors = py::module_::import("ccdt.errors");
  const Place& place = error.place();
  const py::object type = errors.attr(name);
  const py::object raised =
      type(error.what(), errors.attr("Place")(place.file, place.line, place.byte, place.points, place.facets),
           error.remedy());
  PyErr_SetObject(type.ptr(), raised.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const InputError& error) {
    raise("InputError", error);
  } catch (const OutputError& error) {
    raise("OutputError", error);
  } catch (const MemoryError& error) {
    raise("OutOfMemoryError", error);
  } catch (const LimitError& error) {
    raise("LimitError", error);
  } catch (const MeshError& error) {
    raise("MeshError", error);
  } catch (const Error& error) {
    raise("Error", error);
  }
}

}  // namespace

void bind_errors(py::module_&) {
  py::register_local_exception_translator(translate);
}

}  // namespace ccdt::python
