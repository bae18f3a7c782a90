#pragma once

#include <array>

#include "engine/base/enum_names.h"

namespace ccdt::front {

/// How the front finds the apex above a face, and whether it can be seen from there.
enum class Visibility {
  centroid,  ///< first the emptiest sphere, then one line of sight to its vertex, from the centroid of the face
  faces      ///< the paper's (section 5.1): every candidate, through the three triangles that it forms with the edges
};

constexpr auto names_of(Visibility) {
  return std::to_array<NamedValue<Visibility>>(
      {{Visibility::centroid, "centroid", "along one line, and only for the vertex with the emptiest sphere"},
       {Visibility::faces, "faces", "the paper's: through three triangles, for every candidate"}});
}

}  // namespace ccdt::front
