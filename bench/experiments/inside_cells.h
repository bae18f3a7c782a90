#pragma once

#include "engine/mesh/tet_mesh.h"

namespace ccdt::experiments {

/// The tetrahedra away from the surface: none of their vertices is on a listed face, or joined by an edge to one that
/// is. In a mesh of one lattice, these are cells of the lattice. Vertices stay; faces and edges are left out.
/// \pre `mesh` lists its faces on boundary and interior facets
mesh::TetMesh inside_cells(const mesh::TetMesh& mesh);

}  // namespace ccdt::experiments
