#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <span>
#include <string_view>

#include "engine/base/errors.h"
#include "engine/io/formats.h"
#include "engine/io/groups.h"
#include "engine/io/merge_vertices.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {

namespace {

constexpr std::size_t header_size = 84, facet_size = 50, first_corner = 12, corner_size = 12;

/// The number of facets in the header of a binary file.
std::size_t claimed_facets(const FileBytes& file) {
  return number_at<std::uint32_t>(file.bytes.data() + 80);
}

/// Text begins with `solid` and has no control characters. A binary header may also begin with `solid`, but a count or
/// a coordinate soon contains a byte that text does not have.
bool looks_like_text(const FileBytes& file) {
  const std::string_view start = std::string_view(file.bytes).substr(0, 1024);
  for (const char c : start)
    if (static_cast<unsigned char>(c) < 32 && (c < '\t' || c > '\r')) return false;
  return equal_ignoring_case(TextScanner(file, TextScanner::no_comments).peek(), "solid");
}

bool has_binary_size(const FileBytes& file) {
  if (file.bytes.size() < header_size) return false;
  const std::size_t needed = header_size + facet_size * claimed_facets(file);
  // Some writers pad the end, but a whole further facet would be lost data.
  return file.bytes.size() >= needed && file.bytes.size() - needed < facet_size;
}

[[noreturn]] void fail_for_size(const FileBytes& file) {
  const std::size_t size = file.bytes.size();
  const std::string remedy = "copy or export the file again";
  if (size < header_size)
    fail_at_byte(file, size,
                 "the file is truncated, or not an STL file: " + std::to_string(size) +
                     " bytes, but a binary STL begins with a header of 84 bytes and a text STL with 'solid'",
                 remedy);
  const std::size_t count = claimed_facets(file), needed = header_size + facet_size * count;
  const std::string claim = "the header claims " + std::to_string(count) + " triangles (" + std::to_string(needed) +
                            " bytes), but the file has " + std::to_string(size) + " bytes";
  if (needed > size)
    fail_at_byte(file, size, claim + ": it is truncated, or its count is wrong", remedy,
                 {static_cast<long long>((size - header_size) / facet_size)});
  fail_at_byte(file, needed, claim + ": the rest would be lost", remedy);
}

using Corner = VertexMerger<float>::Corner;

/// The three corners of a facet. \throw InputError  one of them is not finite
void read_corners(const FileBytes& file, std::size_t facet, std::span<Corner, 3> corners) {
  const std::size_t begin = header_size + facet * facet_size + first_corner;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = number_at<Corner>(file.bytes.data() + begin + k * corner_size);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!std::isfinite(corners[k][axis]))
        fail_at_byte(file, begin + k * corner_size + 4 * axis,
                     "facet " + std::to_string(facet) + ": a coordinate is not a finite number (NaN or infinite)",
                     "repair this facet, or export the file again", {static_cast<long long>(facet)});
  }
}

plc::InputPlc read_binary(const FileBytes& file) {
  constexpr std::size_t facets_per_batch = 32;
  const std::size_t count = claimed_facets(file);
  plc::InputPlc plc;
  plc.triangles.resize(count);
  VertexMerger<float> merger(plc.vertices);
  merger.reserve(count / 2);  // as in a closed surface, by Euler's formula
  std::array<Corner, 3 * facets_per_batch> corners;
  std::array<std::uint32_t, 3 * facets_per_batch> indices;
  for (std::size_t first = 0; first < count; first += facets_per_batch) {
    const std::size_t facets = std::min(facets_per_batch, count - first);
    for (std::size_t i = 0; i < facets; ++i)
      read_corners(file, first + i, std::span<Corner, 3>(corners.data() + 3 * i, 3));
    merger.indices_of(std::span(corners.data(), 3 * facets), indices);
    for (std::size_t i = 0; i < facets; ++i) std::copy_n(&indices[3 * i], 3, plc.triangles[first + i].begin());
  }
  return plc;
}

void expect(TextScanner& in, const Item& facet, std::string_view keyword, std::string_view found) {
  if (!equal_ignoring_case(found, keyword))
    in.fail(facet, "expected '" + std::string(keyword) + "', found " + in_quotes(found));
}

void expect(TextScanner& in, const Item& facet, std::string_view keyword) {
  expect(in, facet, keyword, in.word(facet));
}

bool is_keyword(std::string_view word) {
  return std::ranges::any_of(
      std::to_array<std::string_view>({"solid", "facet", "outer", "loop", "vertex", "endloop", "endfacet", "endsolid"}),
      [&](std::string_view keyword) { return equal_ignoring_case(word, keyword); });
}

/// The next keyword after the end of a facet or of its loop. Some writers put names and comments there, up to the end
/// of the line.
///
/// \return  empty at the end of the text; "endsolid" also for "end solid"
std::string_view next_keyword(TextScanner& in, const Item& facet) {
  while (!in.at_end()) {
    const std::string_view word = in.word(facet);
    if (is_keyword(word)) return word;
    if (equal_ignoring_case(word, "end") && !in.at_line_end() && equal_ignoring_case(in.word(facet), "solid"))
      return "endsolid";
    in.skip_line();
  }
  return {};
}

/// Reads what follows the word "facet". \return  its corners
std::array<Point3, 3> read_facet(TextScanner& in, const Item& facet) {
  expect(in, facet, "normal");
  for (int k = 0; k < 3; ++k) in.word(facet);  // normals may be NaN, and are not needed
  expect(in, facet, "outer");
  expect(in, facet, "loop");
  std::array<Point3, 3> corners;
  for (Point3& corner : corners) {
    expect(in, facet, "vertex");
    corner = in.point(facet);
  }
  expect(in, facet, "endloop");
  const std::string_view end = next_keyword(in, facet);
  if (end.empty()) in.fail_truncated(facet);
  expect(in, facet, "endfacet", end);
  return corners;
}

plc::InputPlc read_text(const FileBytes& file) {
  plc::InputPlc plc;
  Groups solids;
  VertexMerger<double> merger(plc.vertices);
  TextScanner in(file, TextScanner::no_comments);
  while (!in.at_end()) {
    expect(in, "start of a solid", "solid");
    solids.enter(in.rest_of_line());  // its name, which may be anything
    while (true) {
      const Item facet{"facet", plc.triangles.size()};
      const std::string_view keyword = next_keyword(in, facet);
      if (equal_ignoring_case(keyword, "endsolid")) break;
      if (keyword.empty()) {
        if (plc.triangles.empty()) in.fail_truncated(facet);
        plc.notes.push_back("the file ends without 'endsolid'; it may have been cut off after a whole facet");
        break;
      }
      if (!equal_ignoring_case(keyword, "facet"))
        in.fail(facet, "expected 'facet' or 'endsolid', found " + in_quotes(keyword));
      const std::array<Point3, 3> corners = read_facet(in, facet);
      std::ranges::transform(corners, plc.triangles.emplace_back().begin(),
                             [&](const Point3& p) { return merger.index_of(as_array(p)); });
      plc.triangle_markers.push_back(solids.current());
    }
    in.skip_line();
  }
  if (solids.count() > 1)
    solids.give_markers(plc);
  else
    plc.triangle_markers.clear();  // one solid has no parts to tell apart
  return plc;
}

Point3 unit_normal(const Point3& a, const Point3& b, const Point3& c) {
  const Point3 normal = cross(b - a, c - a);
  const double length = std::sqrt(squared_length(normal));
  return length > 0 && std::isfinite(length) ? (1 / length) * normal : Point3{};
}

}  // namespace

plc::InputPlc read_stl(const FileBytes& file) {
  if (has_binary_size(file)) return read_binary(file);  // even if its header begins with `solid`
  if (looks_like_text(file)) return read_text(file);
  fail_for_size(file);
}

void write_stl(const plc::InputPlc& plc, OutputFile& out) {
  for (const Point3& p : plc.vertices)
    if (std::fabs(p.x) > FLT_MAX || std::fabs(p.y) > FLT_MAX || std::fabs(p.z) > FLT_MAX)
      throw OutputError("STL has single precision only; a coordinate is too large", {.points = {as_array(p)}},
                        "write a .off, .ply or .poly file instead");
  std::string header = "binary STL by ccdt";  // must not begin with `solid`
  header.resize(80, ' ');
  const std::vector<FacetLoop> facets = facets_in_order(plc);
  out << header;
  out.raw(static_cast<std::uint32_t>(facets.size()));
  for (const FacetLoop& facet : facets) {
    std::array<Point3, 4> vectors;  // the normal, then the corners
    for (std::size_t k = 0; k < 3; ++k) vectors[k + 1] = plc.vertices[facet.corners[k]];
    vectors[0] = unit_normal(vectors[1], vectors[2], vectors[3]);
    for (const Point3& p : vectors)
      out.raw(static_cast<float>(p.x)).raw(static_cast<float>(p.y)).raw(static_cast<float>(p.z));
    out.raw(std::uint16_t{0});
  }
}

}  // namespace ccdt::io
