#include "engine/io/medit_parts.h"

#include "engine/io/text_scanner.h"

namespace ccdt::io {

namespace {

bool starts_with_letter(std::string_view word) {
  return !word.empty() && ((word[0] >= 'A' && word[0] <= 'Z') || (word[0] >= 'a' && word[0] <= 'z'));
}

void read_vertices(TextScanner& in, std::vector<Point3>& vertices) {
  const std::size_t count = in.count({"number of vertices"}, 8);
  vertices.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Item vertex{"vertex", static_cast<std::int64_t>(i)};
    vertices.push_back(in.point(vertex));
    in.integer(vertex);  // its reference
  }
}

template <std::size_t Corners>
void read_elements(TextScanner& in, std::string_view kind, std::size_t vertices, std::size_t first_number,
                   MeditElements<Corners>& elements) {
  const std::size_t count = in.count({"number of elements"}, 2 * Corners + 2);
  elements.first_facet = first_number;
  elements.corners.reserve(count);
  elements.references.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Item item{kind, static_cast<std::int64_t>(first_number + i)};
    std::array<std::uint32_t, Corners> corners;
    for (std::uint32_t& corner : corners) corner = in.index(item, 1, vertices);
    elements.corners.push_back(corners);
    elements.references.push_back(in.attribute(item));
  }
}

void skip_section(TextScanner& in) {
  while (!in.at_end() && !starts_with_letter(in.peek())) in.word({"section"});
}

void read_header_number(TextScanner& in, std::string_view keyword) {
  const Item item{keyword};
  const std::int64_t value = in.integer(item);
  if (keyword == "Dimension" && value != 3)
    in.fail(item, "it is " + std::to_string(value) + ", not 3", "give a mesh in three dimensions");
}

}  // namespace

MeditFile read_medit(const FileBytes& file, bool with_tetrahedra) {
  MeditFile mesh;
  TextScanner in(file);
  if (const std::string_view first = in.word({"header"}); first != "MeshVersionFormatted")
    in.fail({"header"}, "expected 'MeshVersionFormatted', found " + in_quotes(first),
            "check that this is a Medit text file");
  read_header_number(in, "MeshVersionFormatted");
  bool ended = false;
  while (!ended && !in.at_end()) {
    const std::string_view keyword = in.word({"keyword"});
    const std::size_t vertices = mesh.vertices.size();
    const std::size_t facets = mesh.triangles.corners.size() + mesh.quadrilaterals.corners.size();
    if (keyword == "Dimension") {
      read_header_number(in, keyword);
    } else if (keyword == "Vertices") {
      read_vertices(in, mesh.vertices);
    } else if (keyword == "Edges") {
      read_elements(in, "edge", vertices, mesh.edges.corners.size(), mesh.edges);
    } else if (keyword == "Triangles") {
      read_elements(in, "facet", vertices, facets, mesh.triangles);
    } else if (keyword == "Quadrilaterals") {
      read_elements(in, "facet", vertices, facets, mesh.quadrilaterals);
    } else if (keyword == "Tetrahedra" && with_tetrahedra) {
      read_elements(in, "tetrahedron", vertices, mesh.tetrahedra.corners.size(), mesh.tetrahedra);
    } else if (keyword == "End") {
      ended = true;
    } else if (starts_with_letter(keyword)) {
      skip_section(in);
    } else {
      in.fail({"keyword"}, "expected a keyword, found " + in_quotes(keyword));
    }
  }
  if (!ended) in.fail_truncated({"keyword 'End'"});
  return mesh;
}

void write_medit_head(std::string_view comment, const std::vector<Point3>& vertices, OutputFile& out) {
  out << "MeshVersionFormatted 2\n" << comment << "\nDimension 3\n\nVertices\n" << vertices.size() << '\n';
  for (const Point3& p : vertices) out << p.x << ' ' << p.y << ' ' << p.z << " 0\n";
}

}  // namespace ccdt::io
