#pragma once

#include <vector>

#include "engine/mesh/tet_mesh.h"

namespace ccdt::mesh {

/// The partitions of listed faces and edges.
struct LowerPartitions {
  std::vector<int> of_faces, of_edges;
};

/// Puts each face and edge into the first partition of a tetrahedron that has it, or into 1 if none has it. Without
/// partitions of tetrahedra, there are none.
LowerPartitions lower_partitions(const TetMesh& mesh);

}  // namespace ccdt::mesh
