#pragma once

#include <string_view>

#include "engine/options/option_table.h"

namespace ccdt::options {

/// Sets an option of the table to a value as on the command line.
///
/// \param name  with dashes or underscores: "edge-length" or "edge_length"
/// \throw InputError  there is no such option, or it has no such value
void set_option(std::string_view name, std::string_view value, MeshOptions& options);

/// \throw InputError  the value of an option of the table is outside of its bounds
void check_bounds(const MeshOption& option, const MeshOptions& options);

}  // namespace ccdt::options
