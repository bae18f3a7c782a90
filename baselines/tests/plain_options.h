#pragma once

#include "engine/mesher.h"

namespace ccdt {

/// Nothing but the vertices of the input.
inline const MeshOptions bare = {.lattice = Lattice::none};

/// Interior points, and tetrahedra as the mesher first makes them.
inline MeshOptions unimproved(double edge_length = 0) {
  return {.edge_length = edge_length, .improve = {.improvement = Improvement::none}};
}

}  // namespace ccdt
