#include "engine/io/medit_parts.h"
#include "engine/io/tet_mesh_formats.h"

namespace ccdt::io {

void write_medit_mesh(const TetMesh& mesh, OutputFile& out) {
  const std::string claim = mesh.constrained_delaunay ? "# " + std::string(constrained_delaunay_claim) : "";
  write_medit_head(claim, mesh.vertices, out);
  write_medit_elements<2>("Edges", mesh.edges, mesh.edge_markers, out);
  write_medit_elements<3>("Triangles", mesh.faces, mesh.face_markers, out);
  write_medit_elements<4>("Tetrahedra", mesh.tetrahedra, mesh.regions, out);
  out << "\nEnd\n";
}

}  // namespace ccdt::io
