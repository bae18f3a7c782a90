#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/io/files.h"
#include "engine/io/gzip.h"
#include "engine/io/write_lines.h"
#include "engine/mesh/element_nodes.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/input.h"

/// The formats: one file each, with what it reads and writes. `read_plc`, `write_plc`, `read_tet_mesh` and
/// `write_tet_mesh` choose among them by the ending.
namespace ccdt::io {

/// `read_plc` of a file in memory.
/// \param format  one of `plc_format_names`; empty: that of the extension of the file's name
plc::InputPlc read_plc(const FileBytes& file, const std::string& format);
/// `read_tet_mesh` of a file in memory. \param format  one of `tet_mesh_formats` with `is_one_file`
mesh::TetMesh read_tet_mesh(const FileBytes& file, const std::string& format);

/// Surfaces and piecewise linear complexes. No reader builds a mesh structure: the caller gets the contents of the
/// file, manifold or not. (OpenMesh's readers drop faces that do not fit a half-edge mesh, read coordinates in single
/// precision, and ignore truncation and NaN. So they serve only as an independent reader in our tests.) The readers
/// fill all of an `InputPlc` except its name. All throw InputError like `read_plc`.
plc::InputPlc read_stl(const FileBytes& file);
plc::InputPlc read_off(const FileBytes& file);
plc::InputPlc read_obj(const FileBytes& file);
plc::InputPlc read_ply(const FileBytes& file);
plc::InputPlc read_poly(const FileBytes& file);
plc::InputPlc read_smesh(const FileBytes& file);
plc::InputPlc read_node(const FileBytes& file);
plc::InputPlc read_medit_plc(const FileBytes& file);
plc::InputPlc read_meditb_plc(const FileBytes& file);
plc::InputPlc read_gmsh_plc(const FileBytes& file);
plc::InputPlc read_vtu_plc(const FileBytes& file);
plc::InputPlc read_vtp(const FileBytes& file);

/// The writers rely on the checks of `write_plc`.
void write_stl(const plc::InputPlc& plc, OutputFile& out);
void write_off(const plc::InputPlc& plc, OutputFile& out);
void write_obj(const plc::InputPlc& plc, OutputFile& out);
void write_ply(const plc::InputPlc& plc, OutputFile& out);
void write_poly(const plc::InputPlc& plc, OutputFile& out);
void write_smesh(const plc::InputPlc& plc, OutputFile& out);
void write_medit_plc(const plc::InputPlc& plc, OutputFile& out);
void write_meditb_plc(const plc::InputPlc& plc, OutputFile& out);

/// Tetrahedral meshes.
mesh::TetMesh read_medit_mesh(const FileBytes& file);
mesh::TetMesh read_meditb_mesh(const FileBytes& file);
mesh::TetMesh read_gmsh(const FileBytes& file);
/// What is in one file.
mesh::TetMesh read_vtu(const FileBytes& file);
/// Reads the faces and edges from the second file (`write_vtu_files`) if there are none in the first.
///
/// \throw InputError  also if the two do not belong together
mesh::TetMesh read_vtu_files(const std::filesystem::path& file);
/// Reads .node and .ele, and .face and .edge if they exist, given the path of one of the first three.
mesh::TetMesh read_tetgen_mesh(const std::filesystem::path& file);

void write_medit_mesh(const mesh::TetMesh& mesh, OutputFile& out);
void write_meditb_mesh(const mesh::TetMesh& mesh, OutputFile& out);
/// Version 2.2 in text, which most programs read.
void write_gmsh(const mesh::ElementNodes& nodes, OutputFile& out);
/// Version 4.1 in binary.
void write_gmsh4(const mesh::ElementNodes& nodes, OutputFile& out);
/// An input file of Abaqus and CalculiX: tetrahedra in a set for each region; for each marker of faces a surface and a
/// set of nodes, for each marker of edges a set of nodes.
void write_abaqus(const mesh::ElementNodes& nodes, OutputFile& out);
/// A folder polyMesh of OpenFOAM: a patch for each marker on the boundary, a zone of faces for each one inside, and
/// zones of cells if there are several regions. Vertices that no tetrahedron has are left out.
///
/// \throw OutputError  something else is in its place (`check_replaces_poly_mesh`), or it cannot be written
void write_poly_mesh(const mesh::TetMesh& mesh, const std::filesystem::path& folder);
/// \throw OutputError  it is neither absent, nor an empty folder, nor a polyMesh
void check_replaces_poly_mesh(const std::filesystem::path& folder);
/// XDMF with all numbers in the text: the tetrahedra with their `region`, and beside it .boundary.xdmf with the faces
/// and their `marker`. Both have all vertices.
void write_xdmf_files(const mesh::ElementNodes& nodes, const std::filesystem::path& file);
/// The tetrahedra with their `region`.
void write_vtu_tetrahedra(const mesh::ElementNodes& nodes, OutputFile& out);
/// The faces and edges on facets and segments with their `marker`, and their points with their `vtu_point_vertex`.
void write_vtu_boundary(const mesh::ElementNodes& nodes, OutputFile& out);
/// Writes the tetrahedra, and beside them a file .boundary.vtu (even an empty one, so that none of an older mesh
/// remains). In one file, a viewer would draw each face twice.
void write_vtu_files(const mesh::ElementNodes& nodes, const std::filesystem::path& file);
/// Writes a file, and another one beside it that has this ending. Both appear or none.
void write_with_boundary(const mesh::ElementNodes& nodes, const std::filesystem::path& file, const char* ending,
                         void (*write_tetrahedra)(const mesh::ElementNodes&, OutputFile&),
                         void (*write_boundary)(const mesh::ElementNodes&, OutputFile&));
/// The array with the node of the mesh for each point.
inline constexpr const char* vtu_point_vertex = "vertex";
/// Writes .node, .ele, .face and .edge (even empty ones, so that no file of an older mesh remains).
void write_tetgen_mesh(const mesh::TetMesh& mesh, const std::filesystem::path& file);

/// Adds a facet with one loop: a triangle, a polygon, or (if it has two corners) a segment. One corner adds nothing.
void add_facet(plc::InputPlc& plc, std::span<const std::uint32_t> corners, int marker, std::size_t number);

/// Call it after adding all facets: it drops numbers that equal the indices, and markers that are all 0.
void finish_facets(plc::InputPlc& plc);

/// A facet with one loop, wherever the PLC stores it.
struct FacetLoop {
  std::span<const std::uint32_t> corners;
  int marker = 0;
  const plc::PolygonFacet* polygon = nullptr;  ///< null for a triangle
  std::uint32_t number = 0;                    ///< in the file
};

/// All facets, in the order of their numbers in the file.
std::vector<FacetLoop> facets_in_order(const plc::InputPlc& plc);

/// Our writers add this comment in formats that are read with seeds if the PLC uses the even-odd rule.
inline constexpr std::string_view even_odd_claim = "# ccdt inside even_odd";

/// The part of a text file where our claims are: comments near its start.
inline std::string_view head_of(const FileBytes& file) {
  return std::string_view(file.bytes).substr(0, 1024);
}
inline plc::InputPlc::Inside inside_claimed(const FileBytes& file) {
  return head_of(file).find(even_odd_claim) != std::string_view::npos ? plc::InputPlc::Inside::even_odd
                                                                      : plc::InputPlc::Inside::seeds;
}

/// What a mesh says of itself that the numbers in its file do not tell, as words of a comment; empty if there is
/// nothing: that it is constrained Delaunay, and that it has no markers, for formats in which each element has a
/// number.
std::string claims_of(const mesh::TetMesh& mesh);

/// Fulfills the claims in a part of a file.
void take_claims(std::string_view part_of_file, mesh::TetMesh& mesh);

/// Has the mesh faces or edges, but no markers of them?
inline bool lacks_markers(const mesh::TetMesh& mesh) {
  return mesh.face_markers.empty() && mesh.edge_markers.empty() && mesh.faces.size() + mesh.edges.size() > 0;
}

/// The i-th attribute; the whole list may be missing.
inline int attribute_of(const std::vector<int>& attributes, std::size_t i) {
  return i < attributes.size() ? attributes[i] : 0;
}

/// The elements with each attribute, in order.
using ElementGroups = std::map<int, std::vector<std::uint32_t>>;

/// \param attributes  as for `attribute_of`
ElementGroups group_elements(std::size_t count, const std::vector<int>& attributes);

/// Writes the corners of an element, each with a blank before it. `first` is the number of the first vertex.
template <class Output>
void write_corners(std::span<const std::uint32_t> corners, Output& out, std::uint32_t first = 1) {
  for (const std::uint32_t v : corners) out << ' ' << v + first;
}

/// Writes a line "number x y z" for each point, numbered from 1.
inline void write_numbered(const std::vector<Point3>& points, OutputFile& out) {
  write_lines(
      points.size(), [&](std::size_t i, auto& text) { text << i + 1 << ' ' << points[i] << '\n'; }, out);
}

/// The file with the same name and another ending. Not .gz, but what is before it, is an ending.
inline std::filesystem::path sibling(const std::filesystem::path& file, const char* ending) {
  return without_gzip(file).replace_extension(ending);
}

}  // namespace ccdt::io
