#include <algorithm>
#include <array>
#include <charconv>

#include "engine/base/simplex_map.h"
#include "engine/io/formats.h"
#include "engine/io/plain_names.h"
#include "engine/mesh/boundary_faces.h"

namespace ccdt::io {

namespace {

/// The number of the face opposite to each corner of a C3D4 or C3D10: its faces are 1-2-3, 1-4-2, 2-4-3 and 3-4-1. Its
/// nodes have the order of ours.
constexpr std::array<int, 4> abaqus_face = {3, 4, 2, 1};

/// Writes a number in the 20 characters that Abaqus and CalculiX read: bit for bit if they suffice.
template <class Output>
void write_short(double value, Output& out) {
  constexpr std::size_t most = 20;
  std::array<char, 40> digits;
  char* const begin = digits.data();
  char* const last = begin + digits.size();
  const char* end = std::to_chars(begin, last, value).ptr;
  for (int precision = 16; end - begin > static_cast<std::ptrdiff_t>(most); --precision)
    end = std::to_chars(begin, last, value, std::chars_format::general, precision).ptr;
  out << std::string_view(begin, end);
}

/// A face of `mesh.faces` as that of a tetrahedron: the one that it faces away from, if that is there.
struct ElementFace {
  std::uint32_t tetrahedron = none;
  int face = 0;
};

std::vector<ElementFace> element_faces(const mesh::TetMesh& mesh) {
  const FaceMap map(mesh.faces, mesh.vertices.size());
  std::vector<ElementFace> faces(mesh.faces.size());
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const auto outward = mesh::outward_faces(mesh.tetrahedra[t]);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [index, faces_the_other_way] = map.find(outward[k][0], outward[k][1], outward[k][2]);
      if (index != none && (faces[index].tetrahedron == none || !faces_the_other_way))
        faces[index] = {t, abaqus_face[k]};
    }
  }
  return faces;
}

/// The set of the nodes of some elements.
template <std::size_t Corners>
void write_node_set(const std::string& name, const mesh::ElementNodes& all,
                    const std::vector<std::array<std::uint32_t, Corners>>& elements,
                    const std::vector<std::uint32_t>& members, OutputFile& out) {
  std::vector<std::uint32_t> nodes;
  for (const std::uint32_t i : members)
    for (std::size_t k = 0; k < all.per_element(Corners); ++k) nodes.push_back(all.node(elements[i], k));
  std::ranges::sort(nodes);
  nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
  constexpr std::size_t most_in_line = 16;
  out << "*NSET, NSET=" << name << '\n';
  for (std::size_t i = 0; i < nodes.size(); ++i)
    out << nodes[i] + 1 << (i + 1 == nodes.size() || (i + 1) % most_in_line == 0 ? "\n" : ", ");
}

void write_regions(const mesh::ElementNodes& nodes, PlainNames& names, OutputFile& out) {
  const mesh::TetMesh& mesh = nodes.mesh();
  const std::size_t per_element = nodes.per_element(4);
  std::string all;
  for (const auto& [region, members] : group_elements(mesh.tetrahedra.size(), mesh.regions)) {
    const std::string name = names.name_of(region, "REGION_");
    all += name + "\n";
    out << "*ELEMENT, TYPE=C3D" << per_element << ", ELSET=" << name << '\n';
    const auto element = [&, &list = members](std::size_t i, auto& text) {
      text << list[i] + 1;
      for (std::size_t k = 0; k < per_element; ++k) text << ", " << nodes.node(mesh.tetrahedra[list[i]], k) + 1;
      text << '\n';
    };
    write_lines(members.size(), element, out);
  }
  out << "*ELSET, ELSET=EALL\n" << all;
}

void write_surfaces(const mesh::ElementNodes& nodes, PlainNames& names, OutputFile& out) {
  const mesh::TetMesh& mesh = nodes.mesh();
  const std::vector<ElementFace> faces = element_faces(mesh);
  for (const auto& [marker, members] : group_elements(mesh.faces.size(), mesh.face_markers)) {
    const std::string name = names.name_of(marker, "MARKER_", mesh.face_names);
    write_node_set(name, nodes, mesh.faces, members, out);
    out << "*SURFACE, NAME=" << name << ", TYPE=ELEMENT\n";
    for (const std::uint32_t i : members)
      if (faces[i].tetrahedron != none) out << faces[i].tetrahedron + 1 << ", S" << faces[i].face << '\n';
  }
}

}  // namespace

void write_abaqus(const mesh::ElementNodes& nodes, OutputFile& out) {
  const mesh::TetMesh& mesh = nodes.mesh();
  PlainNames names;
  out << "*NODE, NSET=NALL\n";
  const auto node = [&](std::size_t i, auto& text) {
    text << i + 1;
    for (const double x : as_array(nodes.point(i))) {
      text << ", ";
      write_short(x, text);
    }
    text << '\n';
  };
  write_lines(nodes.count(), node, out);
  write_regions(nodes, names, out);
  write_surfaces(nodes, names, out);
  for (const auto& [marker, members] : group_elements(mesh.edges.size(), mesh.edge_markers))
    if (marker != 0) write_node_set(names.name_of(marker, "SEGMENT_"), nodes, mesh.edges, members, out);
}

}  // namespace ccdt::io
