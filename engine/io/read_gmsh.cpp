#include "engine/io/gmsh_parts.h"
#include "engine/io/tet_mesh_formats.h"

namespace ccdt::io {

void GmshNodes::add(TextScanner& in, const Item& item, std::int64_t tag, std::size_t index) {
  if (others_.empty() && index == consecutive_ && tag == static_cast<std::int64_t>(index) + 1) {
    ++consecutive_;
    return;
  }
  const bool known = tag >= 1 && tag <= static_cast<std::int64_t>(consecutive_);
  if (known || !others_.emplace(tag, static_cast<std::uint32_t>(index)).second)
    in.fail(item, "there are two nodes with the number " + std::to_string(tag));
}

std::uint32_t GmshNodes::read_index(TextScanner& in, const Item& item) const {
  const std::int64_t tag = in.integer(item);
  if (tag >= 1 && tag <= static_cast<std::int64_t>(consecutive_)) return static_cast<std::uint32_t>(tag - 1);
  const auto found = others_.find(tag);
  if (found == others_.end())
    in.fail(item, "vertex index " + std::to_string(tag) + " is out of range: there is no such node");
  return found->second;
}

namespace {

template <std::size_t Corners>
void read_corners(TextScanner& in, const Item& item, const GmshNodes& nodes, int marker,
                  std::vector<std::array<std::uint32_t, Corners>>& elements, std::vector<int>& markers) {
  std::array<std::uint32_t, Corners> corners;
  for (std::uint32_t& corner : corners) corner = nodes.read_index(in, item);
  elements.push_back(corners);
  markers.push_back(marker);
}

/// \return the major version: 2 or 4
int read_format(TextScanner& in) {
  const Item item{"$MeshFormat"};
  const std::string_view version = in.word(item);
  const bool is_2 = version.starts_with("2"), is_41 = version == "4.1";
  if (!is_2 && !is_41)
    in.fail(item, "version " + in_quotes(version) + " is not supported", "save the mesh as version 2.2 or 4.1, ASCII");
  if (in.integer(item) != 0)
    in.fail(item, "the file is binary", "save the mesh as ASCII (gmsh -save -format msh2 -bin 0)");
  in.integer(item);
  expect_section_end(in, "$MeshFormat");
  return is_2 ? 2 : 4;
}

void skip_section(TextScanner& in, std::string_view section) {
  const std::string end = "$End" + std::string(section.substr(1));
  while (in.word({section}) != end) in.skip_line();
}

}  // namespace

void read_gmsh_element(TextScanner& in, const Item& item, std::int64_t type, int marker, const GmshNodes& nodes,
                       TetMesh& mesh) {
  constexpr std::int64_t line = 1, triangle = 2, tetrahedron = 4, point = 15;
  if (type == line)
    read_corners(in, item, nodes, marker, mesh.edges, mesh.edge_markers);
  else if (type == triangle)
    read_corners(in, item, nodes, marker, mesh.faces, mesh.face_markers);
  else if (type == tetrahedron)
    read_corners(in, item, nodes, marker, mesh.tetrahedra, mesh.regions);
  else if (type == point)
    nodes.read_index(in, item);
  else
    in.fail(item, "elements of type " + std::to_string(type) + " are not supported",
            "write linear tetrahedra, triangles and lines only");
}

void expect_section_end(TextScanner& in, std::string_view section) {
  const std::string end = "$End" + std::string(section.substr(1));
  if (const std::string_view found = in.word({section}); found != end)
    in.fail({section}, "expected '" + end + "', found " + in_quotes(found),
            "correct the counts of this section, or export the file again");
}

TetMesh read_gmsh(const FileBytes& file) {
  TetMesh mesh;
  GmshNodes nodes;
  GmshPhysicalTags tags;
  TextScanner in(file, TextScanner::no_comments);
  int version = 0;
  bool has_elements = false;
  while (!in.at_end()) {
    const std::string_view section = in.word({"section"});
    const bool is_data = section == "$Nodes" || section == "$Elements" || (section == "$Entities" && version == 4);
    if (!section.starts_with("$") || section.size() < 2 || section.starts_with("$End"))
      in.fail({"section"}, "expected the start of a section ($...), found " + in_quotes(section));
    if (section == "$MeshFormat") {
      version = read_format(in);
    } else if (is_data && version == 0) {
      in.fail({section}, "there is no $MeshFormat before it", "save the mesh as version 2.2 or 4.1, ASCII");
    } else if (is_data) {
      if (version == 2)
        read_gmsh2_section(in, section, nodes, mesh);
      else
        read_gmsh4_section(in, section, tags, nodes, mesh);
      expect_section_end(in, section);
      has_elements = has_elements || section == "$Elements";
    } else {
      skip_section(in, section);
    }
  }
  if (!has_elements) in.fail_truncated({"$Elements"});
  mesh.constrained_delaunay = claims_constrained_delaunay(file);
  return mesh;
}

}  // namespace ccdt::io
