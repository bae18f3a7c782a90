#pragma once

#include <pybind11/pybind11.h>

#include "engine/base/progress.h"
#include "engine/sizes/local_sizes.h"

/// Python functions that the engine calls, from any of its threads.
namespace ccdt::python {

/// Runs Python's handlers of signals, so that Ctrl-C ends the work, and calls a function, or None: whenever a stage
/// begins, and then at most twenty times a second.
///
/// \param function  is called as f(stage, done, total); what it raises ends the work
Progress progress_of(pybind11::object function);

/// \param function  is called with an array of n points, and returns n lengths
sizes::SizeFunction size_function_of(pybind11::object function);

}  // namespace ccdt::python
