#include "engine/io/medit_parts.h"
#include "engine/io/tet_mesh_formats.h"

namespace ccdt::io {

TetMesh read_medit_mesh(const FileBytes& file) {
  MeditFile medit = read_medit(file, true);
  TetMesh mesh;
  mesh.vertices = std::move(medit.vertices);
  mesh.tetrahedra = std::move(medit.tetrahedra.corners);
  mesh.regions = std::move(medit.tetrahedra.references);
  mesh.faces = std::move(medit.triangles.corners);
  mesh.face_markers = std::move(medit.triangles.references);
  mesh.edges = std::move(medit.edges.corners);
  mesh.edge_markers = std::move(medit.edges.references);
  mesh.constrained_delaunay = claims_constrained_delaunay(file);
  return mesh;
}

}  // namespace ccdt::io
