#pragma once

#include <string>

#include "engine/mesh/tet_mesh.h"

namespace ccdt::bench {

/// A hash of a mesh, 32 hexadecimal digits: of the coordinates of each vertex, bit for bit, and of the tetrahedra as
/// sets of vertices with their region. Meshes that differ only in the order of their tetrahedra, or of the corners of
/// one, have the same fingerprint; others almost certainly differ (it is not a cryptographic hash). It is the same on
/// every machine.
std::string fingerprint(const mesh::TetMesh& mesh);

}  // namespace ccdt::bench
