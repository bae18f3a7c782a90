#include "engine/io/medit.h"

#include <utility>

#include "engine/io/formats.h"
#include "engine/io/mesh_surface.h"
#include "engine/io/read_lines.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {

namespace {

bool starts_with_letter(std::string_view word) {
  return !word.empty() && ((word[0] >= 'A' && word[0] <= 'Z') || (word[0] >= 'a' && word[0] <= 'z'));
}

void read_vertices(TextScanner& in, std::vector<Point3>& vertices) {
  const std::size_t count = in.count("number of vertices", 8);
  const std::size_t first = vertices.size();
  vertices.resize(first + count);
  read_lines(in, count, [&](TextScanner& line, std::size_t i) {
    const Item vertex{"vertex", i};
    vertices[first + i] = line.point(vertex);
    line.integer(vertex);  // its reference
  });
}

/// \param item  the first element
template <std::size_t Corners>
void read_elements(TextScanner& in, const Item& item, std::size_t vertices,
                   std::vector<std::array<std::uint32_t, Corners>>& elements, std::vector<int>& references) {
  const std::size_t count = in.count("number of elements", 2 * Corners + 2);
  const std::size_t first = elements.size();
  elements.resize(first + count);
  references.resize(first + count);
  read_lines(in, count, [&](TextScanner& line, std::size_t i) {
    const Item element{item.kind, item.number + static_cast<std::int64_t>(i)};
    elements[first + i] = line.indices<Corners>(element, 1, vertices);
    references[first + i] = line.attribute(element);
  });
}

/// \param is_mesh  tetrahedra must follow the facets
MeditFile read_medit(const FileBytes& file, bool is_mesh) {
  MeditFile medit;
  mesh::TetMesh& mesh = medit.mesh;
  TextScanner in(file);
  in.expect("header", "MeshVersionFormatted", "check that this is a Medit text file");
  in.integer("MeshVersionFormatted");
  bool ended = false;
  while (!ended && !in.at_end()) {
    const std::string_view keyword = in.word("keyword");
    const std::size_t vertices = mesh.vertices.size();
    const std::size_t facets = mesh.faces.size() + medit.quadrilaterals.size();
    if (keyword == "Dimension") {
      in.expect_integer("Dimension", 3, "give a mesh in three dimensions");
    } else if (keyword == "Vertices") {
      read_vertices(in, mesh.vertices);
    } else if (keyword == "Edges") {
      read_elements(in, {"edge", mesh.edges.size()}, vertices, mesh.edges, mesh.edge_markers);
    } else if (keyword == "Triangles") {
      medit.first_triangle = facets;
      read_elements(in, {"facet", facets}, vertices, mesh.faces, mesh.face_markers);
    } else if (keyword == "Quadrilaterals") {
      medit.first_quadrilateral = facets;
      read_elements(in, {"facet", facets}, vertices, medit.quadrilaterals, medit.quadrilateral_references);
    } else if (keyword == "Tetrahedra") {
      read_elements(in, {"tetrahedron", mesh.tetrahedra.size()}, vertices, mesh.tetrahedra, mesh.regions);
    } else if (keyword == "End") {
      ended = true;
    } else if (starts_with_letter(keyword)) {
      while (!in.at_end() && !starts_with_letter(in.peek())) in.word("section");
    } else {
      in.fail("keyword", "expected a keyword, found " + in_quotes(keyword));
    }
  }
  // Some programs leave out 'End'. The counts show that the sections are complete, and the line break shows that the
  // last number is.
  const bool has_elements = !mesh.tetrahedra.empty() || (!is_mesh && medit.has_facets());
  const bool is_whole = has_elements && file.bytes.back() == line_end_of(file.bytes);
  if (!ended && !is_whole) in.fail_truncated("keyword 'End'");
  if (!ended) medit.notes.push_back("the keyword 'End' is missing; the file may have been cut off after a section");
  return medit;
}

/// Sections without elements are left out.
///
/// \param comment  a line "# ...", or empty; it comes second because other readers want the version in the first line
/// \param surface  its quadrilaterals are written
void write_medit(std::string_view comment, const mesh::TetMesh& mesh, const MeditFile& surface, OutputFile& out) {
  out << "MeshVersionFormatted 2\n" << comment << "\nDimension 3\n\nVertices\n" << mesh.vertices.size() << '\n';
  write_lines(
      mesh.vertices.size(), [&](std::size_t i, auto& text) { text << mesh.vertices[i] << " 0\n"; }, out);
  const auto write_section = [&](const char* keyword, const auto& elements, const std::vector<int>& references) {
    if (elements.empty()) return;
    out << '\n' << keyword << '\n' << elements.size() << '\n';
    const auto line = [&](std::size_t i, auto& text) {
      for (const std::uint32_t v : elements[i]) text << v + 1 << ' ';
      text << attribute_of(references, i) << '\n';
    };
    write_lines(elements.size(), line, out);
  };
  write_section("Edges", mesh.edges, mesh.edge_markers);
  write_section("Triangles", mesh.faces, mesh.face_markers);
  write_section("Quadrilaterals", surface.quadrilaterals, surface.quadrilateral_references);
  write_section("Tetrahedra", mesh.tetrahedra, mesh.regions);
  out << "\nEnd\n";
}

}  // namespace

plc::InputPlc plc_of(MeditFile medit, plc::InputPlc::Inside inside) {
  if (!medit.mesh.tetrahedra.empty() && medit.quadrilaterals.empty()) {
    plc::InputPlc plc = surface_of(std::move(medit.mesh));
    plc.notes.insert(plc.notes.begin(), medit.notes.begin(), medit.notes.end());
    return plc;
  }
  const mesh::TetMesh& mesh = medit.mesh;
  plc::InputPlc plc;
  plc.inside = inside;
  plc.notes = std::move(medit.notes);
  for (std::size_t i = 0; i < mesh.faces.size(); ++i)
    add_facet(plc, mesh.faces[i], mesh.face_markers[i], medit.first_triangle + i);
  for (std::size_t i = 0; i < medit.quadrilaterals.size(); ++i)
    add_facet(plc, medit.quadrilaterals[i], medit.quadrilateral_references[i], medit.first_quadrilateral + i);
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) add_facet(plc, mesh.edges[i], mesh.edge_markers[i], 0);
  plc.vertices = std::move(medit.mesh.vertices);
  finish_facets(plc);
  return plc;
}

MeditFile medit_of(const plc::InputPlc& plc) {
  MeditFile medit;
  for (const FacetLoop& facet : facets_in_order(plc)) {
    const auto& c = facet.corners;
    if (c.size() == 3) {
      medit.mesh.faces.push_back({c[0], c[1], c[2]});
      medit.mesh.face_markers.push_back(facet.marker);
    } else {
      medit.quadrilaterals.push_back({c[0], c[1], c[2], c[3]});
      medit.quadrilateral_references.push_back(facet.marker);
    }
  }
  medit.mesh.vertices = plc.vertices;
  medit.mesh.edges = plc.segments;
  medit.mesh.edge_markers = plc.segment_markers;
  return medit;
}

plc::InputPlc read_medit_plc(const FileBytes& file) {
  return plc_of(read_medit(file, false), inside_claimed(file));
}

mesh::TetMesh read_medit_mesh(const FileBytes& file) {
  mesh::TetMesh mesh = read_medit(file, true).mesh;
  take_claims(head_of(file), mesh);
  return mesh;
}

void write_medit_plc(const plc::InputPlc& plc, OutputFile& out) {
  const MeditFile medit = medit_of(plc);
  write_medit(plc.inside == plc::InputPlc::Inside::even_odd ? even_odd_claim : "", medit.mesh, medit, out);
}

void write_medit_mesh(const mesh::TetMesh& mesh, OutputFile& out) {
  const std::string claims = claims_of(mesh);
  write_medit(claims.empty() ? "" : "# " + claims, mesh, {}, out);
}

}  // namespace ccdt::io
