#include <map>

#include "engine/io/tet_mesh_formats.h"

namespace ccdt::io {

namespace {

/// Lines "number type 2 physical elementary nodes...". The physical tag is the marker as it is; the elementary tag,
/// which Gmsh wants positive, numbers the different markers.
template <std::size_t Corners>
void write_elements(const std::vector<std::array<std::uint32_t, Corners>>& elements, const std::vector<int>& markers,
                    int type, std::size_t& number, OutputFile& out) {
  std::map<int, std::size_t> elementary;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const int marker = attribute_of(markers, i);
    const std::size_t entity = elementary.try_emplace(marker, elementary.size() + 1).first->second;
    out << ++number << ' ' << type << " 2 " << marker << ' ' << entity;
    for (const std::uint32_t v : elements[i]) out << ' ' << v + 1;
    out << '\n';
  }
}

}  // namespace

/// Version 2.2, which most programs read.
void write_gmsh(const TetMesh& mesh, OutputFile& out) {
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  if (mesh.constrained_delaunay) out << "$Comments\n" << constrained_delaunay_claim << "\n$EndComments\n";
  out << "$Nodes\n" << mesh.vertices.size() << '\n';
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    out << i + 1 << ' ' << mesh.vertices[i].x << ' ' << mesh.vertices[i].y << ' ' << mesh.vertices[i].z << '\n';
  out << "$EndNodes\n$Elements\n" << mesh.edges.size() + mesh.faces.size() + mesh.tetrahedra.size() << '\n';
  std::size_t number = 0;
  write_elements(mesh.edges, mesh.edge_markers, 1, number, out);
  write_elements(mesh.faces, mesh.face_markers, 2, number, out);
  write_elements(mesh.tetrahedra, mesh.regions, 4, number, out);
  out << "$EndElements\n";
}

}  // namespace ccdt::io
