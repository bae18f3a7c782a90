#pragma once

#include <map>
#include <string>
#include <vector>

#include "baselines/mesher.h"

namespace ccdt::baselines {

/// Options of `ccdt mesh` by their names on the command line, without dashes: {"lattice", "bcc"}.
using NamedOptions = std::map<std::string, std::string>;

/// The options of `ccdt mesh` that control meshing, with their defaults; empty if a default depends on the input.
const NamedOptions& usual_options();

/// The options that our engine uses.
std::vector<OptionUse> options_of_engine();

/// Reduces options to those that change what a mesher does, so that sets of options with the same effect are equal.
/// Options that it does not use and default values are removed, and equal numbers are written alike. If only "none"
/// makes a difference, all other values count as the default. `ccdt mesh` does the same with these options as with all.
/// Names that are not in `usual_options` stay.
NamedOptions effective_options(const Mesher& mesher, const NamedOptions& options);

}  // namespace ccdt::baselines
