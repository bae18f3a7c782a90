#include "engine/io/formats.h"
#include "engine/io/read_lines.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {

namespace {

/// The keyword is [ST][C][N][4][n]OFF and may be missing. Texture coordinates, colors and normals follow the
/// coordinates on a vertex's line and are skipped; four-dimensional, n-dimensional and binary files are refused. Some
/// writers put the first count right behind it: "OFF8".
void read_keyword(TextScanner& in) {
  const Item header{"header"};
  const std::string_view first = in.peek();
  const std::string_view keyword = first.substr(0, first.find_last_not_of("0123456789") + 1);
  if (keyword.size() < 3 || !equal_ignoring_case(keyword.substr(keyword.size() - 3), "off")) {
    if (!first.empty() && keyword.empty()) return;
    in.expect(header, "OFF", "check that this is an OFF file");
  }
  in.word(header);
  in.move_to(in.position() - (first.size() - keyword.size()));
  std::string_view prefix = keyword.substr(0, keyword.size() - 3);
  for (const std::string_view part : {"ST", "C", "N"})
    if (prefix.starts_with(part)) prefix.remove_prefix(part.size());
  if (!prefix.empty())
    in.fail(header, "OFF with the prefix " + in_quotes(prefix) + " is not supported",
            "export it as plain three-dimensional OFF");
  if (!in.at_line_end() && equal_ignoring_case(in.peek(), "binary")) {
    in.word(header);
    in.fail(header, "binary OFF is not supported", "export it as text");
  }
}

/// "corners c1 c2 ... [color]" for each.
void read_facets(TextScanner& in, std::size_t count, plc::InputPlc& plc) {
  plc.triangles.resize(count);
  const auto read_triangle = [&](TextScanner& line, std::size_t i) {
    const Item facet{"facet", i};
    line.expect_integer(facet, 3, "");
    plc.triangles[i] = line.indices<3>(facet, 0, plc.vertices.size());
    line.skip_line();
  };
  if (read_lines_together(in, count, read_triangle)) return;
  plc.triangles.clear();
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < count; ++i) {
    const Item facet{"facet", i};
    corners.resize(in.count(facet, 2));
    if (corners.empty()) in.fail(facet, "it has no corners");
    for (std::uint32_t& corner : corners) corner = in.index(facet, 0, plc.vertices.size());
    in.skip_line();
    add_facet(plc, corners, 0, i);
  }
}

}  // namespace

plc::InputPlc read_off(const FileBytes& file) {
  plc::InputPlc plc;
  TextScanner in(file);
  read_keyword(in);
  const std::size_t vertices = in.count({"number of vertices"}, 6), faces = in.count({"number of facets"}, 4);
  in.skip_line();  // the number of edges, which may be missing and is not used
  plc.vertices.resize(vertices);
  read_lines(in, vertices, [&](TextScanner& line, std::size_t i) {
    plc.vertices[i] = line.point({"vertex", i});
    line.skip_line();
  });
  read_facets(in, faces, plc);
  if (!in.at_end()) {
    const Item end{"end of the file"};
    const std::string_view found = in.word(end);
    in.fail(end, "found " + in_quotes(found) + " after the last of " + std::to_string(faces) + " facets",
            "correct the counts in the header, or export the file again");
  }
  finish_facets(plc);
  return plc;
}

void write_off(const plc::InputPlc& plc, OutputFile& out) {
  out << "OFF\n" << plc.vertices.size() << ' ' << plc.facet_count() << " 0\n";
  for (const Point3& p : plc.vertices) out << p << '\n';
  for (const FacetLoop& facet : facets_in_order(plc)) {
    out << facet.corners.size();
    write_corners(facet.corners, out, 0);
    out << '\n';
  }
}

}  // namespace ccdt::io
