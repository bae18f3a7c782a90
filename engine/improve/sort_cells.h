#pragma once

#include "engine/mesh/tet_mesh.h"

namespace ccdt {

/// Brings the tetrahedra, with their regions, and the corners of each into an order that depends on nothing but the set
/// of tetrahedra: what is done cell by cell has the same result whatever strategy made the mesh. Neighbors in space
/// are mostly near to each other in it, as interior vertices are numbered along a space-filling curve.
void sort_cells(TetMesh& mesh);

}  // namespace ccdt
