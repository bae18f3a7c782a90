#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/tet_mesh.h"

namespace ccdt::mesh {

/// The faces that belong to one tetrahedron only, facing away from it, in the order of the tetrahedra.
std::vector<std::array<std::uint32_t, 3>> boundary_faces(const TetMesh& mesh);

}  // namespace ccdt::mesh
