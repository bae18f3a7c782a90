#pragma once

#include <CLI/CLI.hpp>

#include "engine/plc/input.h"
#include "engine/surface/mark_by_angle.h"

namespace ccdt::tools {

/// Where the markers of an input come from, in verbs that do not mesh.
struct MarkerOptions {
  surface::MarkerSource source = surface::MarkerSource::file;
  double sharp_angle = surface::usual_sharp_angle;  ///< in degrees
};

/// Adds --markers.
void add_markers(CLI::App& verb, surface::MarkerSource& source);
/// Adds --markers and --sharp-angle, as `ccdt mesh` has them.
void add_markers(CLI::App& verb, MarkerOptions& options);

/// Gives markers to the facets, if that was asked for.
/// \throw InputError  see `surface::mark_by_angle`
void mark(plc::InputPlc& input, const MarkerOptions& options, double flatness);

}  // namespace ccdt::tools
