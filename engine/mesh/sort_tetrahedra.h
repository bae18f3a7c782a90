#pragma once

#include "engine/mesh/tet_mesh.h"

namespace ccdt::mesh {

/// Brings the tetrahedra, with their regions, and the corners of each into an order that depends on nothing but the set
/// of tetrahedra: the mesh is the same, byte for byte, whatever strategy made it and on however many threads. The first
/// corner of each is its least vertex. Tetrahedra that are close in space are mostly close in this order, because
/// interior vertices are numbered along a space-filling curve.
void sort_tetrahedra(TetMesh& mesh);

}  // namespace ccdt::mesh
