#pragma once

#include <span>
#include <string_view>

#include "engine/plc/input.h"

namespace ccdt::models {

/// One of the solids that `ccdt model` knows.
struct Solid {
  std::string_view name;
  std::string_view what;  ///< one line for people
  double default_edge_length;
  double finest, coarsest;                    ///< the edge lengths for which it keeps its shape and fits into memory
  plc::InputPlc (*make)(double edge_length);  ///< does not check the edge length; `make_solid` does
};

/// piston, bracket, stepping-pole (our models of the paper's three parts, in millimeters: the paper gives
/// neither geometry nor sizes), cube, graded-cube, sphere, rough-sphere, torus (of
/// size one), schoenhardt (always the same).
///
/// Each group of faces has its own marker, counted from 1 (models/parts.h lists them). All are closed surfaces except
/// the bracket. It also has facets inside, with the markers 8 (between its two regions) and 9 (a slit).
std::span<const Solid> solids();

/// The solid of that name with triangles of about that edge length (units of the model; <= 0: its default).
/// \throw InputError  no such solid (the known ones are listed), or an edge length that is too long or too short for
/// it
plc::InputPlc make_solid(std::string_view name, double edge_length);

}  // namespace ccdt::models
