#pragma once

#include "engine/mesh/tet_mesh.h"
#include "engine/plc/input.h"

namespace ccdt::io {

/// The surface or PLC of a mesh from a file: its faces and edges. If there are tetrahedra, their boundary is added
/// where the file lists no face, with a note. Vertices that belong to none of these are left out, such as the centers
/// of circles in Gmsh's files.
plc::InputPlc surface_of(mesh::TetMesh mesh);

}  // namespace ccdt::io
