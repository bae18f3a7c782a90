#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "baselines/mesher.h"
#include "engine/base/enum_names.h"

namespace ccdt::baselines {

/// Options of `ccdt mesh` by their names on the command line, without dashes: {"lattice", "bcc"}.
using NamedOptions = std::map<std::string, std::string>;

/// The options of `ccdt mesh` that control meshing, with their defaults; empty if a default depends on the input.
const NamedOptions& usual_options();

/// Strategies that belong together.
enum class Strategies { usual, paper };

constexpr auto names_of(Strategies) {
  return std::to_array<NamedValue<Strategies>>(
      {{Strategies::usual, "default", "the fastest"},
       {Strategies::paper, "paper",
        "the paper's algorithm: --delaunay wrap --locator grid --protection midpoint --visibility faces "
        "--improve swap-smooth"}});
}

/// The options that strategies stand for, except the given ones. Without interior points, there is no improvement
/// either.
NamedOptions options_of(Strategies strategies, const NamedOptions& given);

/// Replaces the option "strategies", if there is one, by the options that it stands for.
NamedOptions with_strategies(NamedOptions options);

/// Does the option name a file? Its name is without dashes.
bool names_a_file(std::string_view option);

/// The options that our engine uses.
std::vector<OptionUse> options_of_engine();

/// Reduces options to those that change what a mesher does, so that sets of options with the same effect are equal.
/// Options that it does not use and default values are removed, and equal numbers are written alike. If only "none"
/// makes a difference, all other values count as the default. `ccdt mesh` does the same with these options as with all
/// of them. Names that are not in `usual_options` stay.
NamedOptions effective_options(const Mesher& mesher, const NamedOptions& options);

}  // namespace ccdt::baselines
