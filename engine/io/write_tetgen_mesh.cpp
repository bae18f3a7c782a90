#include "engine/io/tet_mesh_formats.h"
#include "engine/io/tetgen_parts.h"

namespace ccdt::io {

namespace {

template <std::size_t Corners>
void write_elements(const std::vector<std::array<std::uint32_t, Corners>>& elements, const std::vector<int>& attributes,
                    OutputFile& out) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    out << i + 1;
    for (const std::uint32_t v : elements[i]) out << ' ' << v + 1;
    out << ' ' << attribute_of(attributes, i) << '\n';
  }
}

}  // namespace

void write_tetgen_mesh(const TetMesh& mesh, const std::filesystem::path& file) {
  OutputFile node(sibling(file, ".node")), ele(sibling(file, ".ele")), face(sibling(file, ".face")),
      edge(sibling(file, ".edge"));
  write_tetgen_nodes(mesh.vertices, node);
  if (mesh.constrained_delaunay) ele << "# " << constrained_delaunay_claim << '\n';
  ele << mesh.tetrahedra.size() << " 4 1\n";
  write_elements(mesh.tetrahedra, mesh.regions, ele);
  face << mesh.faces.size() << " 1\n";
  write_elements(mesh.faces, mesh.face_markers, face);
  edge << mesh.edges.size() << " 1\n";
  write_elements(mesh.edges, mesh.edge_markers, edge);
  for (OutputFile* out : {&node, &ele, &face, &edge}) out->close();
  for (OutputFile* out : {&node, &ele, &face, &edge}) out->commit();
}

}  // namespace ccdt::io
