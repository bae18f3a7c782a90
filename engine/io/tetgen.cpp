#include <algorithm>
#include <utility>

#include "engine/io/formats.h"
#include "engine/io/read_lines.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {

namespace {

/// TetGen's files number the vertices from 0 or 1, and all lists use these numbers.
struct TetgenNodes {
  std::vector<Point3> vertices;
  std::int64_t first = 0;
};

/// Reads a list of nodes: a line "count dimension attributes markers", then "number x y z ..." for each node.
TetgenNodes read_nodes(TextScanner& in) {
  TetgenNodes nodes;
  const std::size_t count = in.count("number of vertices", 8);
  if (!in.at_line_end()) in.expect_integer("dimension", 3, "give points in three dimensions");
  in.skip_line();  // the numbers of attributes and markers after each point; both are skipped with the line
  if (count == 0) return nodes;
  const Item first_vertex{"vertex", 0};
  TextScanner ahead = in;
  nodes.first = ahead.integer(first_vertex);
  if (nodes.first != 0 && nodes.first != 1)
    ahead.fail(first_vertex, "the first vertex has the number " + std::to_string(nodes.first),
               "number the vertices from 0 or 1");
  nodes.vertices.resize(count);
  read_lines(in, count, [&](TextScanner& line, std::size_t i) {
    const Item vertex{"vertex", i};
    const std::int64_t number = line.integer(vertex), expected = nodes.first + vertex.number;
    if (number != expected)
      line.fail(vertex,
                "its number is " + std::to_string(number) + ", but " + std::to_string(expected) + " was expected",
                "number the vertices without gaps");
    nodes.vertices[i] = line.point(vertex);
    line.skip_line();
  });
  return nodes;
}

TetgenNodes read_nodes(const FileBytes& file) {
  TextScanner in(file);
  return read_nodes(in);
}

/// The nodes are in the file itself or, if their count is 0, in the .node file of the same name.
TetgenNodes read_nodes_here_or_beside(const FileBytes& file, TextScanner& in) {
  TetgenNodes nodes = read_nodes(in);
  if (nodes.vertices.empty()) nodes = read_nodes(read_whole_file(sibling(file.name, ".node")));
  return nodes;
}

int read_marker(TextScanner& in, const Item& facet, bool has_markers) {
  return has_markers && !in.at_line_end() ? in.attribute(facet) : 0;
}

std::vector<std::uint32_t> read_polygon(TextScanner& in, const Item& facet, const TetgenNodes& nodes) {
  std::vector<std::uint32_t> corners(in.count(facet, 2));
  if (corners.empty()) in.fail(facet, "a polygon without corners");
  for (std::uint32_t& corner : corners) corner = in.index(facet, nodes.first, nodes.vertices.size());
  return corners;
}

/// A facet of .poly: a line "polygons holes marker", the polygons, the holes.
void read_poly_facet(TextScanner& in, const TetgenNodes& nodes, bool has_markers, const Item& item,
                     plc::InputPlc& plc) {
  plc::PolygonFacet facet;
  facet.number = static_cast<std::uint32_t>(item.number);
  const std::size_t polygons = in.count(item, 4);
  const std::size_t holes = in.at_line_end() ? 0 : in.count(item, 8);
  facet.marker = read_marker(in, item, has_markers);
  in.skip_line();
  for (std::size_t i = 0; i < polygons; ++i) {
    facet.polygons.push_back(read_polygon(in, item, nodes));
    in.skip_line();
  }
  for (std::size_t i = 0; i < holes; ++i) {
    in.integer(item);
    facet.holes.push_back(in.point(item));
    in.skip_line();
  }
  // Without an area, there is no facet but only segments, and vertices that are in the list of nodes anyway.
  const bool has_area = std::ranges::any_of(facet.polygons, [](const auto& polygon) { return polygon.size() > 2; });
  if (!has_area || (facet.polygons.size() == 1 && facet.polygons[0].size() == 3 && holes == 0)) {
    for (const auto& polygon : facet.polygons) add_facet(plc, polygon, facet.marker, facet.number);
  } else {
    plc.polygon_facets.push_back(std::move(facet));
  }
}

/// A facet of .smesh: "corners c1 c2 ... marker".
void read_smesh_facet(TextScanner& in, const TetgenNodes& nodes, bool has_markers, const Item& item,
                      plc::InputPlc& plc) {
  const std::vector<std::uint32_t> corners = read_polygon(in, item, nodes);
  add_facet(plc, corners, read_marker(in, item, has_markers), static_cast<std::size_t>(item.number));
  in.skip_line();
}

/// Reads a list of items that begin with "number x y z"; the list may be missing.
template <class ReadRest>
void read_seeds(TextScanner& in, std::string_view kind, std::size_t least_bytes_each, const ReadRest& read_rest) {
  if (in.at_end()) return;
  const std::size_t count = in.count(std::string_view("number of " + std::string(kind) + "s"), least_bytes_each);
  in.skip_line();
  for (std::size_t i = 0; i < count; ++i) {
    const Item item{kind, i};
    in.integer(item);
    read_rest(item, in.point(item));
    in.skip_line();
  }
}

using FacetReader = void (*)(TextScanner&, const TetgenNodes&, bool, const Item&, plc::InputPlc&);

plc::InputPlc read_tetgen_plc(const FileBytes& file, FacetReader read_facet) {
  plc::InputPlc plc;
  plc.inside = inside_claimed(file);
  TextScanner in(file);
  TetgenNodes nodes = read_nodes_here_or_beside(file, in);
  const std::size_t facets = in.count("number of facets", 4);
  const bool has_markers = !in.at_line_end() && in.integer("facet markers") != 0;
  in.skip_line();
  for (std::size_t i = 0; i < facets; ++i) read_facet(in, nodes, has_markers, {"facet", i}, plc);
  read_seeds(in, "hole", 8, [&](const Item&, const Point3& seed) { plc.holes.push_back(seed); });
  read_seeds(in, "region", 10, [&](const Item& item, const Point3& seed) {  // and "attribute [largest volume]"
    plc.regions.push_back({seed, in.attribute(item)});
    if (!in.at_line_end()) plc.regions.back().max_volume = std::max(0.0, in.number(item));  // TetGen: negative is none
  });
  plc.vertices = std::move(nodes.vertices);
  finish_facets(plc);
  return plc;
}

/// "count [corners of each] attributes", then "number corners... [attribute]" for each. Tetrahedra without attributes
/// are in region 0; faces and edges without attributes have no markers.
template <std::size_t Corners>
void read_elements(const FileBytes& file, std::string_view kind, const TetgenNodes& nodes,
                   std::vector<std::array<std::uint32_t, Corners>>& elements, std::vector<int>& attributes) {
  TextScanner in(file);
  const std::size_t count = in.count("number of elements", 2 * (Corners + 1));
  if (Corners == 4 && !in.at_line_end())
    in.expect_integer("corners of a tetrahedron", 4, "write linear tetrahedra", "they are");
  const bool has_attribute = !in.at_line_end() && in.integer("number of attributes") != 0;
  in.skip_line();
  elements.resize(count);
  attributes.resize(has_attribute || Corners == 4 ? count : 0);
  read_lines(in, count, [&](TextScanner& line, std::size_t i) {
    const Item item{kind, i};
    line.integer(item);
    elements[i] = line.indices<Corners>(item, nodes.first, nodes.vertices.size());
    if (has_attribute && !line.at_line_end()) attributes[i] = line.attribute(item);
    line.skip_line();  // adjacent tetrahedra, more attributes
  });
}

void write_nodes(const std::vector<Point3>& vertices, OutputFile& out) {
  out << vertices.size() << " 3 0 0\n";
  write_numbered(vertices, out);
}

void write_head(const plc::InputPlc& plc, OutputFile& out) {
  if (plc.inside == plc::InputPlc::Inside::even_odd) out << even_odd_claim << '\n';
  write_nodes(plc.vertices, out);
  out << plc.facet_count() + plc.segments.size() << " 1\n";
}

/// Writes "count v1 v2 ...".
void write_polygon(std::span<const std::uint32_t> corners, OutputFile& out) {
  out << corners.size();
  write_corners(corners, out);
}

void write_seeds(const plc::InputPlc& plc, OutputFile& out) {
  out << plc.holes.size() << '\n';
  write_numbered(plc.holes, out);
  out << plc.regions.size() << '\n';
  for (std::size_t i = 0; i < plc.regions.size(); ++i) {
    const plc::InputPlc::RegionSeed& region = plc.regions[i];
    out << i + 1 << ' ' << region.seed << ' ' << region.attribute << ' ';
    if (region.max_volume > 0)
      out << region.max_volume;
    else
      out << -1;
    out << '\n';
  }
}

template <std::size_t Corners>
void write_elements(const std::vector<std::array<std::uint32_t, Corners>>& elements, const std::vector<int>& attributes,
                    OutputFile& out) {
  const bool has_attribute = !attributes.empty() || Corners == 4;
  out << elements.size() << (Corners == 4 ? " 4 " : " ") << (has_attribute ? 1 : 0) << '\n';
  const auto line = [&](std::size_t i, auto& text) {
    text << i + 1;
    write_corners(elements[i], text);
    if (has_attribute) text << ' ' << attribute_of(attributes, i);
    text << '\n';
  };
  write_lines(elements.size(), line, out);
}

}  // namespace

plc::InputPlc read_poly(const FileBytes& file) {
  return read_tetgen_plc(file, read_poly_facet);
}
plc::InputPlc read_smesh(const FileBytes& file) {
  return read_tetgen_plc(file, read_smesh_facet);
}

plc::InputPlc read_node(const FileBytes& file) {
  plc::InputPlc plc;
  plc.inside = plc::InputPlc::Inside::seeds;
  plc.vertices = read_nodes(file).vertices;
  return plc;
}

void write_poly(const plc::InputPlc& plc, OutputFile& out) {
  write_head(plc, out);
  const auto write_simple_facet = [&](std::span<const std::uint32_t> corners, int marker) {
    out << "1 0 " << marker << '\n';
    write_polygon(corners, out);
    out << '\n';
  };
  for (const FacetLoop& facet : facets_in_order(plc)) {
    if (!facet.polygon) {
      write_simple_facet(facet.corners, facet.marker);
      continue;
    }
    out << facet.polygon->polygons.size() << ' ' << facet.polygon->holes.size() << ' ' << facet.marker << '\n';
    for (const auto& polygon : facet.polygon->polygons) {
      write_polygon(polygon, out);
      out << '\n';
    }
    write_numbered(facet.polygon->holes, out);
  }
  for (std::size_t i = 0; i < plc.segments.size(); ++i)
    write_simple_facet(plc.segments[i], attribute_of(plc.segment_markers, i));
  write_seeds(plc, out);
}

void write_smesh(const plc::InputPlc& plc, OutputFile& out) {
  write_head(plc, out);
  const auto write_facet = [&](std::span<const std::uint32_t> corners, int marker) {
    write_polygon(corners, out);
    out << ' ' << marker << '\n';
  };
  for (const FacetLoop& facet : facets_in_order(plc)) write_facet(facet.corners, facet.marker);
  for (std::size_t i = 0; i < plc.segments.size(); ++i)
    write_facet(plc.segments[i], attribute_of(plc.segment_markers, i));
  write_seeds(plc, out);
}

mesh::TetMesh read_tetgen_mesh(const std::filesystem::path& file) {
  check_is_file(file);  // the message should name the file that the user gave
  TetgenNodes nodes = read_nodes(read_whole_file(sibling(file, ".node")));
  const FileBytes ele_file = read_whole_file(sibling(file, ".ele"));
  mesh::TetMesh mesh;
  read_elements(ele_file, "tetrahedron", nodes, mesh.tetrahedra, mesh.regions);
  if (const auto face_file = sibling(file, ".face"); is_there(face_file))
    read_elements(read_whole_file(face_file), "face", nodes, mesh.faces, mesh.face_markers);
  if (const auto edge_file = sibling(file, ".edge"); is_there(edge_file))
    read_elements(read_whole_file(edge_file), "edge", nodes, mesh.edges, mesh.edge_markers);
  mesh.vertices = std::move(nodes.vertices);
  take_claims(head_of(ele_file), mesh);
  return mesh;
}

void write_tetgen_mesh(const mesh::TetMesh& mesh, const std::filesystem::path& file) {
  OutputFile node(sibling(file, ".node")), ele(sibling(file, ".ele")), face(sibling(file, ".face")),
      edge(sibling(file, ".edge"));
  write_nodes(mesh.vertices, node);
  if (const std::string claims = claims_of(mesh); !claims.empty()) ele << "# " << claims << '\n';
  write_elements(mesh.tetrahedra, mesh.regions, ele);
  write_elements(mesh.faces, mesh.face_markers, face);
  write_elements(mesh.edges, mesh.edge_markers, edge);
  for (OutputFile* out : {&node, &ele, &face, &edge}) out->close();
  for (OutputFile* out : {&node, &ele, &face, &edge}) out->commit();
}

}  // namespace ccdt::io
