#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "bench/gate/side_program.h"

namespace ccdt::gate {

/// Builds programs again with other layouts, when they are asked for. Each is built once.
///
/// `command` is run by /bin/sh in the current folder, once for each side and layout, with these variables:
///   CCDT_GATE_SIDE     "base" or "head"
///   CCDT_GATE_SEED     a whole number from 1, different for each layout; base and head get the same numbers
///   CCDT_GATE_PROGRAM  the path of the program as given
///   CCDT_GATE_OUTPUT   the path where the new program must be when the command ends
///
/// \param folder  for the programs and the log of the last build; exists
/// \return        the function for `Programs::rebuilt`; if a build fails, it throws InputError with the last lines of
///                the log
std::function<std::filesystem::path(Side, int layout)> layout_builder(const std::string& command,
                                                                      const Programs& programs,
                                                                      const std::filesystem::path& folder);

}  // namespace ccdt::gate
