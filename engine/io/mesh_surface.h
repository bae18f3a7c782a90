#pragma once

#include "engine/mesh/tet_mesh.h"
#include "engine/plc/input.h"

namespace ccdt::io {

/// The surface or PLC of a mesh from a file: its faces and edges. If there are tetrahedra, their boundary and the faces
/// between regions are added where the file lists no face, with a note; the inside is where the tetrahedra are, and
/// their regions keep their attributes. Vertices that belong to none of these are left out, such as the centers
/// of circles in Gmsh's files.
plc::InputPlc surface_of(mesh::TetMesh mesh);

}  // namespace ccdt::io
