#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/mesh/tet_mesh.h"

namespace ccdt::io {

/// Can `write_tet_mesh` write files with this extension?
bool is_tet_mesh_file(const std::filesystem::path& file);

/// Checks before hours of work that `write_tet_mesh` knows the format, and that nothing else has the name.
///
/// \param file,format,order  as for `write_tet_mesh`
/// \param partitioned        will the mesh have partitions?
/// \throw OutputError  unknown extension; the format does not hold elements of this order, or partitions; a folder is
/// where a file
///                     will be, or something that is no polyMesh is where a polyMesh
///                     will be
void check_tet_mesh_output(const std::filesystem::path& file, const std::string& format = {}, int order = 1,
                           bool partitioned = false);

/// The names of all formats: their extensions without the dot.
std::vector<std::string> tet_mesh_formats();

/// Is a mesh in this format one file, and not a folder or several files?
bool is_one_file(const std::string& format);

/// Writes a mesh; the extension determines the format, unless one is given: .mesh (Medit, text), .meshb (Medit,
/// binary), .vtu (VTK, compressed; faces and edges in a second file .boundary.vtu), .msh (Gmsh 2.2, text), .msh4
/// (Gmsh 4.1, binary), .inp (Abaqus and CalculiX), .xdmf (FEniCS; faces in a second file .boundary.xdmf), .polymesh (a
/// folder polyMesh of OpenFOAM), .node, .ele or .face (TetGen: all three and .edge are written). Coordinates are
/// written so that they read back bit for bit, except in .inp, which allows 20 characters for each. Regions, face and
/// edge markers are written too, and partitions in .msh, .msh4 and .vtu; .xdmf and .polymesh hold no edges. The file or
/// folder appears completely or not at all.
///
/// \param mesh    the lists of attributes are empty or complete
/// \param file    is replaced, with those that belong to it
/// \param format  one of `tet_mesh_formats`, such as "msh4" for a file .msh; empty: that of the extension
/// \param order   1, or 2 for elements with a node in the middle of each straight edge (tetrahedra with ten nodes):
///                .msh, .msh4, .vtu, .inp and .xdmf; `read_tet_mesh` does not read them
/// \throw OutputError  cannot be written, unknown extension, the format does not hold elements of this order or
/// partitions, or an
///                     index, a list or a coordinate of the
///                     mesh is wrong
void write_tet_mesh(const mesh::TetMesh& mesh, const std::filesystem::path& file, const std::string& format = {},
                    int order = 1);

/// Reads a mesh that any mesher wrote in one of these formats: Medit text, .meshb versions 1 to 4, .vtu in text, base64
/// or appended, with or without zlib, and .msh 2.x and 4.1 in text and binary. Of TetGen's files, .node and .ele must
/// exist; .face and .edge are optional. Tetrahedra keep the order of their corners, right or wrong, so that `verify`
/// sees it. Each attribute array has one entry per element; those of markers have none if the file has no markers.
/// `constrained_delaunay` is true only if our own writer left that claim in the file.
///
/// \throw InputError  as in `read_plc`
mesh::TetMesh read_tet_mesh(const std::filesystem::path& file);

}  // namespace ccdt::io
