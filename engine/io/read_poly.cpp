#include <algorithm>

#include "engine/io/plc_formats.h"
#include "engine/io/tetgen_parts.h"

namespace ccdt::io {

namespace {

/// The nodes stand in the file itself or, when their count is 0, in the .node file beside it.
TetgenNodes read_nodes_here_or_beside(const FileBytes& file, TextScanner& in) {
  TetgenNodes nodes = read_tetgen_nodes(in);
  if (!nodes.vertices.empty()) return nodes;
  const std::filesystem::path beside = sibling(file.name, ".node");
  const FileBytes node_file = read_whole_file(beside);
  TextScanner node_in(node_file);
  return read_tetgen_nodes(node_in);
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

bool has_area(const PolygonFacet& facet) {
  for (const auto& polygon : facet.polygons)
    if (polygon.size() > 2) return true;
  return false;
}

/// A facet of .poly: a line "polygons holes marker", the polygons, the holes.
void read_poly_facet(TextScanner& in, const TetgenNodes& nodes, bool has_markers, const Item& item, InputPlc& plc) {
  PolygonFacet facet;
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
    skip_number(in, item);
    facet.holes.push_back(in.point(item));
    in.skip_line();
  }
  // Without an area there is no facet: segments, and vertices, which are in the list of nodes anyway.
  if (!has_area(facet) || (facet.polygons.size() == 1 && facet.polygons[0].size() == 3 && holes == 0)) {
    for (const auto& polygon : facet.polygons) add_facet(plc, polygon, facet.marker, facet.number);
  } else {
    plc.polygon_facets.push_back(std::move(facet));
  }
}

/// A facet of .smesh: "corners c1 c2 ... marker".
void read_smesh_facet(TextScanner& in, const TetgenNodes& nodes, bool has_markers, const Item& item, InputPlc& plc) {
  const std::vector<std::uint32_t> corners = read_polygon(in, item, nodes);
  add_facet(plc, corners, read_marker(in, item, has_markers), static_cast<std::uint32_t>(item.number));
  in.skip_line();
}

/// "number x y z" each. The list may be missing.
void read_holes(TextScanner& in, InputPlc& plc) {
  if (in.at_end()) return;
  const std::size_t count = in.count({"number of holes"}, 8);
  in.skip_line();
  for (std::size_t i = 0; i < count; ++i) {
    const Item hole{"hole", static_cast<std::int64_t>(i)};
    skip_number(in, hole);
    plc.holes.push_back(in.point(hole));
    in.skip_line();
  }
}

/// "number x y z attribute [largest volume]" each. The list may be missing.
void read_regions(TextScanner& in, InputPlc& plc) {
  if (in.at_end()) return;
  const std::size_t count = in.count({"number of regions"}, 10);
  in.skip_line();
  for (std::size_t i = 0; i < count; ++i) {
    const Item item{"region", static_cast<std::int64_t>(i)};
    InputPlc::RegionSeed region;
    skip_number(in, item);
    region.seed = in.point(item);
    region.attribute = in.attribute(item);
    if (!in.at_line_end()) region.max_volume = std::max(0.0, in.number(item));  // TetGen: negative is none
    in.skip_line();
    plc.regions.push_back(region);
  }
}

using FacetReader = void (*)(TextScanner&, const TetgenNodes&, bool, const Item&, InputPlc&);

InputPlc read_tetgen_plc(const FileBytes& file, FacetReader read_facet) {
  InputPlc plc;
  plc.inside = inside_claimed(file);
  TextScanner in(file);
  TetgenNodes nodes = read_nodes_here_or_beside(file, in);
  const std::size_t facets = in.count({"number of facets"}, 4);
  const bool has_markers = !in.at_line_end() && in.integer({"facet markers"}) != 0;
  in.skip_line();
  for (std::size_t i = 0; i < facets; ++i)
    read_facet(in, nodes, has_markers, {"facet", static_cast<std::int64_t>(i)}, plc);
  read_holes(in, plc);
  read_regions(in, plc);
  plc.vertices = std::move(nodes.vertices);
  finish_facets(plc);
  return plc;
}

}  // namespace

InputPlc read_poly(const FileBytes& file) {
  return read_tetgen_plc(file, read_poly_facet);
}
InputPlc read_smesh(const FileBytes& file) {
  return read_tetgen_plc(file, read_smesh_facet);
}

InputPlc read_node(const FileBytes& file) {
  InputPlc plc;
  plc.inside = InputPlc::Inside::seeds;
  TextScanner in(file);
  plc.vertices = read_tetgen_nodes(in).vertices;
  return plc;
}

}  // namespace ccdt::io
