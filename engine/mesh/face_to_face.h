#pragma once

#include "engine/mesh/tet_mesh.h"

namespace ccdt::mesh {

/// Is no face on the same side of two tetrahedra?
bool is_face_to_face(const TetMesh& mesh);

}  // namespace ccdt::mesh
