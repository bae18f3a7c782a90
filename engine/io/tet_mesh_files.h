#pragma once

#include <filesystem>

#include "engine/mesh/tet_mesh.h"

namespace ccdt::io {

/// Is the ending one that `write_tet_mesh` knows? To be asked before hours of work.
bool is_tet_mesh_file(const std::filesystem::path& file);

/// Writes a mesh; the format is told by the ending: .mesh (Medit), .vtu (VTK), .msh (Gmsh), .node, .ele or .face
/// (TetGen: all three and .edge are written). Coordinates are written so that they read back bit for bit. Regions, face
/// and edge markers go through. The file appears whole or not at all.
///
/// \throw OutputError  cannot be written, unknown ending
void write_tet_mesh(const mesh::TetMesh& mesh, const std::filesystem::path& file);

/// Reads a mesh that any mesher wrote in one of these formats: Medit ASCII, .vtu uncompressed, .msh 2.x and 4.1 ASCII.
/// Of TetGen's files .node and .ele must be there, .face and .edge may. Tetrahedra keep the order of their corners,
/// right or wrong: `verify` is to see it. Each attribute array has one entry an element. `constrained_delaunay` is true
/// only if our own writer left that claim in the file.
///
/// \throw InputError  as `read_plc`
mesh::TetMesh read_tet_mesh(const std::filesystem::path& file);

}  // namespace ccdt::io
