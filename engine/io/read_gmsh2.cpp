#include "engine/io/gmsh_parts.h"

namespace ccdt::io {

namespace {

void read_nodes(TextScanner& in, GmshNodes& nodes, TetMesh& mesh) {
  const std::size_t count = in.count({"number of nodes"}, 8);
  mesh.vertices.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Item vertex{"vertex", static_cast<std::int64_t>(i)};
    nodes.add(in, vertex, in.integer(vertex), mesh.vertices.size());
    mesh.vertices.push_back(in.point(vertex));
  }
}

/// "number type tags physical elementary ... nodes ..."
void read_elements(TextScanner& in, const GmshNodes& nodes, TetMesh& mesh) {
  const std::size_t count = in.count({"number of elements"}, 8);
  for (std::size_t i = 0; i < count; ++i) {
    const Item item{"element", static_cast<std::int64_t>(i)};
    in.integer(item);
    const std::int64_t type = in.integer(item);
    const std::size_t tags = in.count(item, 2);
    int physical = 0;
    for (std::size_t k = 0; k < tags; ++k) {
      if (k == 0)
        physical = in.attribute(item);
      else
        in.integer(item);
    }
    read_gmsh_element(in, item, type, physical, nodes, mesh);
  }
}

}  // namespace

void read_gmsh2_section(TextScanner& in, std::string_view section, GmshNodes& nodes, TetMesh& mesh) {
  if (section == "$Nodes")
    read_nodes(in, nodes, mesh);
  else
    read_elements(in, nodes, mesh);
}

}  // namespace ccdt::io
