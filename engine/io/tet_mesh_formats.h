#pragma once

#include <filesystem>
#include <string_view>

#include "engine/io/file_bytes.h"
#include "engine/io/output_file.h"
#include "engine/mesh/tet_mesh.h"

/// The formats of tetrahedral meshes, one file a format and direction, dispatched by `read_tet_mesh` and
/// `write_tet_mesh`.
namespace ccdt::io {

TetMesh read_medit_mesh(const FileBytes& file);
TetMesh read_vtu(const FileBytes& file);
TetMesh read_gmsh(const FileBytes& file);
/// Reads .node and .ele, and .face and .edge where they are, given the path of one of the first three.
TetMesh read_tetgen_mesh(const std::filesystem::path& file);

void write_medit_mesh(const TetMesh& mesh, OutputFile& out);
void write_vtu(const TetMesh& mesh, OutputFile& out);
void write_gmsh(const TetMesh& mesh, OutputFile& out);
/// Writes .node, .ele, .face and .edge (also empty ones, so that none is left of an older mesh).
void write_tetgen_mesh(const TetMesh& mesh, const std::filesystem::path& file);

/// How text formats keep `TetMesh::constrained_delaunay`: words in a comment near the file's start.
inline constexpr std::string_view constrained_delaunay_claim = "ccdt constrained_delaunay";
bool claims_constrained_delaunay(const FileBytes& file);

/// The i-th of the attributes, which may be missing as a whole.
inline int attribute_of(const std::vector<int>& attributes, std::size_t i) {
  return i < attributes.size() ? attributes[i] : 0;
}

}  // namespace ccdt::io
