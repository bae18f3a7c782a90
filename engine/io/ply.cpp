#include <algorithm>
#include <climits>
#include <cmath>
#include <utility>

#include "engine/io/byte_scanner.h"
#include "engine/io/formats.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {

namespace {

enum class Encoding { text, little_endian, big_endian };

template <class Number>
double decode(const char* bytes, bool big_endian) {
  return static_cast<double>(number_at<Number>(bytes, big_endian));
}

struct Type {
  const char *name, *alias;
  std::size_t size;
  bool is_real;
  double (*decode)(const char* bytes, bool big_endian);
};

constexpr Type number_types[] = {
    {"char", "int8", 1, false, decode<std::int8_t>},    {"uchar", "uint8", 1, false, decode<std::uint8_t>},
    {"short", "int16", 2, false, decode<std::int16_t>}, {"ushort", "uint16", 2, false, decode<std::uint16_t>},
    {"int", "int32", 4, false, decode<std::int32_t>},   {"uint", "uint32", 4, false, decode<std::uint32_t>},
    {"float", "float32", 4, true, decode<float>},       {"double", "float64", 8, true, decode<double>}};

struct Property {
  std::string name;
  const Type* type = nullptr;
  const Type* list_count = nullptr;  ///< of a list: the type of its count; null for a single value
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

/// Other elements are skipped.
bool is_read(const Element& element) {
  return element.name == "vertex" || element.name == "face" || element.name == "tristrips";
}

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  std::size_t end = 0;  ///< of the header, where the data begin

  const Element* find(std::string_view name) const {
    const auto found = std::ranges::find(elements, name, &Element::name);
    return found == elements.end() ? nullptr : &*found;
  }
};

const Type* read_type(TextScanner& in) {
  const std::string_view name = in.word("header");
  for (const Type& type : number_types)
    if (name == type.name || name == type.alias) return &type;
  in.fail("header", "unknown type " + in_quotes(name));
}

Property read_property(TextScanner& in) {
  Property property;
  if (in.peek() == "list") {
    in.word("header");
    property.list_count = read_type(in);
    if (property.list_count->is_real) in.fail("header", "the count of a list cannot be a real number");
  }
  property.type = read_type(in);
  property.name = in.word("header");
  return property;
}

Encoding read_encoding(TextScanner& in) {
  const std::string_view name = in.word("header");
  if (name == "ascii") return Encoding::text;
  if (name == "binary_little_endian") return Encoding::little_endian;
  if (name == "binary_big_endian") return Encoding::big_endian;
  in.fail("header", "unknown format " + in_quotes(name), "export it as ascii or binary_little_endian");
}

Header read_header(const FileBytes& file) {
  TextScanner in(file, TextScanner::no_comments);
  const Item item = "header";
  in.expect(item, "ply", "check that this is a PLY file");
  Header header;
  bool has_format = false;
  while (true) {
    const std::string_view keyword = in.word(item);
    if (keyword == "end_header") break;
    if (keyword == "format") {
      header.encoding = read_encoding(in);
      has_format = true;
    } else if (keyword == "element") {
      Element element;
      element.name = in.word(item);
      element.count = in.count("count of an element", 0);
      if (is_read(element) && header.find(element.name)) in.fail(item, "a second element " + in_quotes(element.name));
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) in.fail(item, "a property before the first element");
      header.elements.back().properties.push_back(read_property(in));
      continue;
    } else if (keyword != "comment" && keyword != "obj_info") {
      in.fail(item, "unknown keyword " + in_quotes(keyword));
    }
    in.skip_line();
  }
  if (!has_format) in.fail(item, "the format is missing");
  in.skip_line();
  header.end = in.position();
  return header;
}

/// Are the counts possible for the size of the file? Tested before anything is allocated.
void check_counts(const FileBytes& file, const Header& header) {
  std::size_t needed = 0;
  for (const Element& element : header.elements) {
    std::size_t bytes = 0;
    for (const Property& property : element.properties)
      bytes +=
          header.encoding == Encoding::text ? 2 : (property.list_count ? property.list_count : property.type)->size;
    needed += element.count * bytes;
  }
  const std::size_t available = file.bytes.size() - header.end;
  if (needed > available + 1)
    fail_at_byte(file, header.end,
                 "the header claims elements of at least " + std::to_string(needed) + " bytes, but only " +
                     std::to_string(available) + " bytes follow",
                 "the file is truncated or its header is wrong: export it again");
}

/// The values after the header, one by one, in any encoding.
class Values {
 public:
  Values(const FileBytes& file, const Header& header)
      : file_(file),
        encoding_(header.encoding),
        bytes_(file, header.end),
        text_(file, TextScanner::no_comments, header.end) {}

  double next(const Type& type, const Item& item) {
    if (encoding_ == Encoding::text) return text_.number(item);
    return type.decode(bytes_.take(item, type.size), encoding_ == Encoding::big_endian);
  }
  void skip(const Type& type, const Item& item) {
    if (encoding_ == Encoding::text)
      text_.word(item);  // may be NaN
    else
      bytes_.skip(item, type.size);
  }
  double coordinate(const Type& type, const Item& item) {
    const double value = next(type, item);
    if (!std::isfinite(value)) fail(item, "a coordinate is not a finite number (NaN or infinite)");
    return value;
  }
  std::int64_t whole(const Type& type, const Item& item) {
    const double value = next(type, item);
    if (!(std::fabs(value) <= 4294967295.0) || value != std::floor(value)) fail(item, "expected a whole number");
    return static_cast<std::int64_t>(value);
  }
  [[noreturn]] void fail(const Item& item, const std::string& what) const {
    if (encoding_ == Encoding::text) text_.fail(item, what);
    bytes_.fail(item, what, "repair this item, or export the file again");
  }
  /// Anything except blanks after the last element would be lost data.
  void expect_end() {
    if (encoding_ == Encoding::text) {
      if (!text_.at_end()) text_.fail("end of the file", "the file goes on after the last element of the header");
      return;
    }
    for (std::size_t i = bytes_.position(); i < file_.bytes.size(); ++i)
      if (static_cast<unsigned char>(file_.bytes[i]) > 32)
        fail_at_byte(file_, i, "the file goes on after the last element of the header",
                     "the header is wrong: export the file again");
  }
  std::size_t remaining() const { return encoding_ == Encoding::text ? text_.remaining() : bytes_.remaining(); }

 private:
  const FileBytes& file_;
  Encoding encoding_;
  ByteScanner bytes_;
  TextScanner text_;
};

std::size_t list_length(Values& values, const Property& property, const Item& item) {
  const std::int64_t length = values.whole(*property.list_count, item);
  if (length < 0 || static_cast<std::size_t>(length) > values.remaining())
    values.fail(item, "a list of " + std::to_string(length) + " values does not fit into the rest of the file");
  return static_cast<std::size_t>(length);
}

void skip_property(Values& values, const Property& property, const Item& item) {
  const std::size_t length = property.list_count ? list_length(values, property, item) : 1;
  for (std::size_t k = 0; k < length; ++k) values.skip(*property.type, item);
}

void read_vertex(Values& values, const Element& element, const Item& item, plc::InputPlc& plc) {
  std::array<double, 3> xyz{};
  for (const Property& property : element.properties) {
    const std::string& name = property.name;
    if (!property.list_count && (name == "x" || name == "y" || name == "z"))
      xyz[static_cast<std::size_t>(name[0] - 'x')] = values.coordinate(*property.type, item);
    else
      skip_property(values, property, item);
  }
  plc.vertices.push_back({xyz[0], xyz[1], xyz[2]});
}

bool is_corner_list(const Property& property) {
  return property.list_count && (property.name == "vertex_indices" || property.name == "vertex_index");
}

std::uint32_t corner_at(const Values& values, const Item& item, std::int64_t index, std::size_t vertices) {
  if (index < 0 || static_cast<std::size_t>(index) >= vertices)
    values.fail(item, "vertex index " + std::to_string(index) + " is out of range: the file has " +
                          std::to_string(vertices) + " vertices, counted from 0");
  return static_cast<std::uint32_t>(index);
}

void read_face(Values& values, const Element& element, const Item& facet, std::size_t vertices, plc::InputPlc& plc,
               std::vector<std::uint32_t>& corners) {
  int marker = 0;
  for (const Property& property : element.properties) {
    if (is_corner_list(property)) {
      corners.resize(list_length(values, property, facet));
      if (corners.size() < 3)
        values.fail(facet, "it has " + std::to_string(corners.size()) + " corners, but needs at least three");
      for (std::uint32_t& corner : corners)
        corner = corner_at(values, facet, values.whole(*property.type, facet), vertices);
    } else if (property.name == "marker" && !property.list_count && !property.type->is_real) {
      const std::int64_t value = values.whole(*property.type, facet);
      if (value < INT_MIN || value > INT_MAX) values.fail(facet, "its marker does not fit in 32 bits");
      marker = static_cast<int>(value);
    } else {
      skip_property(values, property, facet);
    }
  }
  add_facet(plc, corners, marker, static_cast<std::size_t>(facet.number));
}

/// Strips of triangles, one after another: each corner makes a triangle with the two before it; every second triangle
/// is turned. -1 begins a new strip.
void read_strips(Values& values, const Element& element, const Item& item, std::size_t vertices, plc::InputPlc& plc) {
  for (const Property& property : element.properties) {
    if (!is_corner_list(property)) {
      skip_property(values, property, item);
      continue;
    }
    std::array<std::uint32_t, 2> last{};
    std::size_t length = 0;  // of the strip so far
    for (std::size_t left = list_length(values, property, item); left > 0; --left) {
      const std::int64_t index = values.whole(*property.type, item);
      if (index == -1) {
        length = 0;
        continue;
      }
      const std::uint32_t corner = corner_at(values, item, index, vertices);
      if (++length > 2) {
        const bool is_turned = length % 2 == 0;
        add_facet(plc, std::array{last[is_turned ? 1 : 0], last[is_turned ? 0 : 1], corner}, 0, plc.facet_count());
      }
      last = {last[1], corner};
    }
  }
}

void check_properties(const FileBytes& file, const Element& element) {
  const auto has = [&](auto wanted) {
    return std::any_of(element.properties.begin(), element.properties.end(), wanted);
  };
  if (element.name == "vertex")
    for (const char* axis : {"x", "y", "z"})
      if (!has([&](const Property& p) { return p.name == axis && !p.list_count; }))
        fail_at_byte(file, 0, std::string("vertices have no property '") + axis + "'", "export the file again");
  if ((element.name == "face" || element.name == "tristrips") && !has(is_corner_list))
    fail_at_byte(file, 0, element.name + " has no list 'vertex_indices' or 'vertex_index'", "export the file again");
}

}  // namespace

plc::InputPlc read_ply(const FileBytes& file) {
  const Header header = read_header(file);
  check_counts(file, header);
  plc::InputPlc plc;
  Values values(file, header);
  std::vector<std::uint32_t> corners;
  const Element* const vertex = header.find("vertex");
  const std::size_t vertices = vertex ? vertex->count : 0;
  for (const Element& element : header.elements) {
    if (element.count == 0) continue;
    check_properties(file, element);
    if (element.properties.empty()) continue;
    for (std::size_t i = 0; i < element.count; ++i) {
      if (element.name == "vertex") {
        read_vertex(values, element, {"vertex", i}, plc);
      } else if (element.name == "face") {
        read_face(values, element, {"facet", i}, vertices, plc, corners);
      } else if (element.name == "tristrips") {
        read_strips(values, element, {"strips", i}, vertices, plc);
      } else {
        for (const Property& property : element.properties) skip_property(values, property, {"element", i});
      }
    }
  }
  values.expect_end();
  finish_facets(plc);
  return plc;
}

void write_ply(const plc::InputPlc& plc, OutputFile& out) {
  const std::vector<FacetLoop> facets = facets_in_order(plc);
  bool short_lists = true, markers = false;
  for (const FacetLoop& facet : facets) {
    short_lists = short_lists && facet.corners.size() <= 255;
    markers = markers || facet.marker != 0;
  }
  out << "ply\nformat binary_little_endian 1.0\ncomment ccdt\nelement vertex " << plc.vertices.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << facets.size()
      << "\nproperty list " << (short_lists ? "uchar" : "uint") << " uint vertex_indices\n"
      << (markers ? "property int marker\n" : "") << "end_header\n";
  for (const Point3& p : plc.vertices) out.raw(p.x).raw(p.y).raw(p.z);
  for (const FacetLoop& facet : facets) {
    if (short_lists)
      out.raw(static_cast<std::uint8_t>(facet.corners.size()));
    else
      out.raw(static_cast<std::uint32_t>(facet.corners.size()));
    for (const std::uint32_t v : facet.corners) out.raw(v);
    if (markers) out.raw(facet.marker);
  }
}

}  // namespace ccdt::io
