#pragma once

#include <cstddef>

#include "engine/plc/build_plc.h"

namespace ccdt::repair {

/// Removes triangles that hang on the surface and bound nothing: their open edges end at an edge of several triangles,
/// instead of going around a hole. With them go all those that are connected to them by edges of two triangles.
/// Triangles that are connected to nothing go as well.
///
/// \return  the number of removed triangles
std::size_t remove_flaps(plc::UncheckedPlc& soup);

/// What was done to holes.
struct HoleCounts {
  std::size_t filled = 0;
  std::size_t triangles = 0;  ///< that fill them
  std::size_t left = 0;       ///< that no polygon fills
};

/// Which open edges are filled.
enum class Rims {
  of_holes,  ///< loops, and chains that an edge of two triangles closes: a third one was there
  all        ///< also chains that any other edge closes
};

/// Fills each loop of open edges as a polygon: a flat one by its triangulation in the plane, another one so that it
/// bends least (`plc::triangulate_bent_facets`).
HoleCounts fill_holes(plc::UncheckedPlc& soup, Rims which = Rims::of_holes);

}  // namespace ccdt::repair
