#include "engine/io/tet_mesh_formats.h"
#include "engine/io/tetgen_parts.h"

namespace ccdt::io {

namespace {

/// "count [corners of each] attributes", then "number corners... [attribute]" an element.
template <std::size_t Corners>
void read_elements(const FileBytes& file, std::string_view kind, const TetgenNodes& nodes,
                   std::vector<std::array<std::uint32_t, Corners>>& elements, std::vector<int>& attributes) {
  TextScanner in(file);
  const std::size_t count = in.count({"number of elements"}, 2 * (Corners + 1));
  if (Corners == 4 && !in.at_line_end())
    if (const std::int64_t corners = in.integer({"corners of a tetrahedron"}); corners != 4)
      in.fail({"corners of a tetrahedron"}, "they are " + std::to_string(corners) + ", not 4",
              "write linear tetrahedra");
  const bool has_attribute = !in.at_line_end() && in.integer({"number of attributes"}) != 0;
  in.skip_line();
  elements.reserve(count);
  attributes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Item item{kind, static_cast<std::int64_t>(i)};
    skip_number(in, item);
    std::array<std::uint32_t, Corners> corners;
    for (std::uint32_t& corner : corners) corner = in.index(item, nodes.first, nodes.vertices.size());
    elements.push_back(corners);
    attributes.push_back(has_attribute && !in.at_line_end() ? in.attribute(item) : 0);
    in.skip_line();  // adjacent tetrahedra, more attributes
  }
}

template <std::size_t Corners>
void read_elements_if_there(const std::filesystem::path& file, std::string_view kind, const TetgenNodes& nodes,
                            std::vector<std::array<std::uint32_t, Corners>>& elements, std::vector<int>& attributes) {
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) read_elements(read_whole_file(file), kind, nodes, elements, attributes);
}

}  // namespace

TetMesh read_tetgen_mesh(const std::filesystem::path& file) {
  check_is_file(file);  // the message should name what the user named
  const FileBytes node_file = read_whole_file(sibling(file, ".node"));
  TextScanner node_in(node_file);
  TetgenNodes nodes = read_tetgen_nodes(node_in);
  const FileBytes ele_file = read_whole_file(sibling(file, ".ele"));
  TetMesh mesh;
  read_elements(ele_file, "tetrahedron", nodes, mesh.tetrahedra, mesh.regions);
  read_elements_if_there(sibling(file, ".face"), "face", nodes, mesh.faces, mesh.face_markers);
  read_elements_if_there(sibling(file, ".edge"), "edge", nodes, mesh.edges, mesh.edge_markers);
  mesh.vertices = std::move(nodes.vertices);
  mesh.constrained_delaunay = claims_constrained_delaunay(ele_file);
  return mesh;
}

}  // namespace ccdt::io
