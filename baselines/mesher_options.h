#pragma once

#include <map>
#include <string>
#include <vector>

#include "baselines/mesher.h"

namespace ccdt::baselines {

/// Options of `ccdt mesh` by their names on the command line, without dashes: {"lattice", "bcc"}.
using NamedOptions = std::map<std::string, std::string>;

/// The options of `ccdt mesh` that say how to mesh, with the values that they have where they are not given; empty if
/// that depends on the input.
const NamedOptions& usual_options();

/// What our own engine uses.
std::vector<OptionUse> options_of_engine();

/// Those of the options that change what a mesher does, so that sets of options with the same effect are equal: without
/// what it does not use, without usual values, and with equal numbers written alike. A value of which only matters that
/// it is not "none" counts as the usual one. With these options, `ccdt mesh` does the same as with all. Names that are
/// not among `usual_options` stay.
NamedOptions effective_options(const Mesher& mesher, const NamedOptions& options);

}  // namespace ccdt::baselines
