#include <optional>

#include "engine/io/formats.h"
#include "engine/io/groups.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {

namespace {

/// A corner is v, v/vt, v//vn or v/vt/vn; only v counts. It counts from 1 or, if negative, back from the last vertex so
/// far.
std::uint32_t read_corner(TextScanner& in, const Item& facet, std::size_t vertices) {
  const std::string_view word = in.word(facet), digits = word.substr(0, word.find('/'));
  const std::optional<std::int64_t> parsed = parse_whole<std::int64_t>(digits);
  if (!parsed) in.fail(facet, "expected a vertex index, found " + in_quotes(word));
  const std::int64_t index = *parsed, count = static_cast<std::int64_t>(vertices);
  if (index < -count || index > count || index == 0)
    in.fail(facet,
            "vertex index " + std::to_string(index) +
                " is out of range: " + (count == 0 ? "no" : std::to_string(count)) + " vertices come before it",
            "correct the index; vertices are numbered from 1 and must come before the facets that use them");
  return static_cast<std::uint32_t>(index > 0 ? index - 1 : count + index);
}

}  // namespace

plc::InputPlc read_obj(const FileBytes& file) {
  plc::InputPlc plc;
  Groups groups;
  TextScanner in(file);
  in.join_lines_at_backslash();
  std::size_t faces = 0;
  std::vector<std::uint32_t> corners;
  while (!in.at_end()) {
    const std::string_view keyword = in.word("statement");
    if (keyword == "v") {
      plc.vertices.push_back(in.point({"vertex", plc.vertices.size()}));
      in.skip_line();
    } else if (keyword == "f") {
      const Item facet{"facet", faces};
      corners.clear();
      while (!in.at_line_end()) corners.push_back(read_corner(in, facet, plc.vertices.size()));
      if (corners.size() < 3) in.fail(facet, "it has " + std::to_string(corners.size()) + " corners, but needs three");
      add_facet(plc, corners, groups.current(), faces++);
    } else if (keyword == "g" || keyword == "o") {
      groups.enter(in.rest_of_line());
    } else {
      while (!in.at_line_end()) in.word("statement");  // joined lines count as one
      in.skip_line();
    }
  }
  groups.give_markers(plc);
  finish_facets(plc);
  return plc;
}

void write_obj(const plc::InputPlc& plc, OutputFile& out) {
  for (const Point3& p : plc.vertices) out << "v " << p << '\n';
  int group = 0;
  for (const FacetLoop& facet : facets_in_order(plc)) {
    if (facet.marker != group) {
      group = facet.marker;
      out << "g " << group << '\n';
    }
    out << 'f';
    write_corners(facet.corners, out);
    out << '\n';
  }
}

}  // namespace ccdt::io
