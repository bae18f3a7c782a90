#pragma once

#include <cstdint>

#include "engine/base/progress.h"
#include "engine/improve/counts.h"
#include "engine/improve/options.h"
#include "engine/mesh/tet_mesh.h"

namespace ccdt {

struct ImprovedMesh {
  mesh::TetMesh mesh;
  improve::ImproveCounts counts;
};

/// Improves a tetrahedral mesh from anywhere: by swaps, by moving interior vertices, and by inserting and collapsing
/// them. All faces that the mesh lists, its boundary, the faces between regions, the listed edges, and their vertices
/// stay as they are; other vertices may move or go. The mesh then lists all these faces; those that it did not list get
/// marker 0.
///
/// \param mesh        any conforming mesh in any units, with tetrahedra of either orientation. Vertices that no
///                    tetrahedron has stay
/// \param options     targets and strategies; its rules for the boundary and for Steiner vertices play no part
/// \param threads     how many work at the same time; 0: one per core. Same mesh
/// \param progress    called repeatedly; throw from it to cancel
/// \return            vertices on those faces and edges come first, in their old order; there are no partitions
/// \throw InputError  the mesh is not one: an index out of range, a flat tetrahedron, tetrahedra that share a face but
///                    not its two sides, a listed face or edge that no tetrahedron has; or an option is out of range
/// \throw ...         any exception of `progress`
ImprovedMesh improve_tet_mesh(mesh::TetMesh mesh, const improve::ImproveOptions& options = {}, unsigned threads = 0,
                              const Progress& progress = {});

}  // namespace ccdt
