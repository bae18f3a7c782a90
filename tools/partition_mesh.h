#pragma once

#include <cstdint>

#include "engine/mesh/tet_mesh.h"

namespace ccdt::tools {

/// How even the partitions of a mesh are.
struct PartitionSizes {
  std::uint64_t least = 0, most = 0;  ///< tetrahedra in one
  std::uint64_t cut_faces = 0;        ///< inner faces between two
};

/// Divides the tetrahedra into connected-as-possible partitions of about the same size with few faces between them, by
/// METIS (Karypis and Kumar 1998). The same mesh is always divided in the same way.
///
/// \param count       at least 1
/// \param mesh        gets its `partitions`, numbered from 1
/// \throw LimitError  there are fewer tetrahedra than partitions, or more than METIS can count
PartitionSizes partition_mesh(int count, mesh::TetMesh& mesh);

}  // namespace ccdt::tools
