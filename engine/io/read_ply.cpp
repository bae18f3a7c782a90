#include <algorithm>
#include <bit>
#include <climits>
#include <cmath>
#include <cstring>
#include <optional>

#include "engine/io/plc_formats.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {

namespace {

enum class Encoding { text, little_endian, big_endian };

struct Type {
  enum Kind { signed_integer, unsigned_integer, real } kind;
  std::size_t size;
};

struct Property {
  std::string name;
  Type type;
  std::optional<Type> list_count;  ///< of a list: the type of its count
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  std::size_t end = 0;  ///< where the data begin

  std::size_t vertices() const {
    for (const Element& element : elements)
      if (element.name == "vertex") return element.count;
    return 0;
  }
};

Type read_type(TextScanner& in) {
  static constexpr struct {
    const char *name, *alias;
    Type type;
  } types[] = {{"char", "int8", {Type::signed_integer, 1}},   {"uchar", "uint8", {Type::unsigned_integer, 1}},
               {"short", "int16", {Type::signed_integer, 2}}, {"ushort", "uint16", {Type::unsigned_integer, 2}},
               {"int", "int32", {Type::signed_integer, 4}},   {"uint", "uint32", {Type::unsigned_integer, 4}},
               {"float", "float32", {Type::real, 4}},         {"double", "float64", {Type::real, 8}}};
  const std::string_view name = in.word({"header"});
  for (const auto& type : types)
    if (name == type.name || name == type.alias) return type.type;
  in.fail({"header"}, "unknown type " + in_quotes(name));
}

Property read_property(TextScanner& in) {
  Property property;
  if (in.peek() == "list") {
    in.word({"header"});
    property.list_count = read_type(in);
    if (property.list_count->kind == Type::real) in.fail({"header"}, "the count of a list cannot be a real number");
  }
  property.type = read_type(in);
  property.name = in.word({"header"});
  return property;
}

Encoding read_encoding(TextScanner& in) {
  const std::string_view name = in.word({"header"});
  if (name == "ascii") return Encoding::text;
  if (name == "binary_little_endian") return Encoding::little_endian;
  if (name == "binary_big_endian") return Encoding::big_endian;
  in.fail({"header"}, "unknown format " + in_quotes(name), "export it as ascii or binary_little_endian");
}

Header read_header(const FileBytes& file) {
  TextScanner in(file, TextScanner::no_comments);
  const Item item{"header"};
  if (const std::string_view magic = in.word(item); magic != "ply")
    in.fail(item, "expected 'ply', found " + in_quotes(magic), "check that this is a PLY file");
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
      element.count = in.count({"count of an element"}, 0);
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
  if (!has_format) in.fail(item, "it does not say the format");
  in.skip_line();
  header.end = in.position();
  return header;
}

/// Do the counts fit into what the file has? Asked before anything is allocated.
void check_counts(const FileBytes& file, const Header& header) {
  std::size_t needed = 0;
  for (const Element& element : header.elements) {
    std::size_t bytes = 0;
    for (const Property& property : element.properties)
      bytes += header.encoding == Encoding::text
                   ? 2
                   : (property.list_count ? property.list_count->size : property.type.size);
    needed += element.count * bytes;
    if (element.name == "tristrips" && element.count > 0)
      fail_at_byte(file, 0, "facets in strips of triangles (element tristrips) are not supported",
                   "export them as faces");
  }
  const std::size_t available = file.bytes.size() - header.end;
  if (needed > available + 1)
    fail_at_byte(file, header.end,
                 "the header claims elements of at least " + std::to_string(needed) + " bytes, but only " +
                     std::to_string(available) + " bytes follow",
                 "the file is truncated or its header is wrong: export it again");
}

/// The values after the header, one by one, in whichever encoding.
class Values {
 public:
  Values(const FileBytes& file, const Header& header)
      : file_(file), encoding_(header.encoding), byte_(header.end), text_(file, TextScanner::no_comments, header.end) {}

  double next(Type type, const Item& item) {
    if (encoding_ == Encoding::text) return text_.number(item);
    begin_ = byte_;
    if (type.size > file_.bytes.size() - byte_)
      fail_at_byte(file_, file_.bytes.size(), "the file is truncated: it ends within " + name_of(item),
                   "copy or export the file again", facets_of(item));
    char bytes[8];
    std::memcpy(bytes, file_.bytes.data() + byte_, type.size);
    if (encoding_ == Encoding::big_endian) std::reverse(bytes, bytes + type.size);
    byte_ += type.size;
    return decoded(type, bytes);
  }
  void skip(Type type, const Item& item) {
    if (encoding_ == Encoding::text)
      text_.word(item);  // may be NaN
    else
      next(type, item);
  }
  double coordinate(Type type, const Item& item) {
    const double value = next(type, item);
    if (!std::isfinite(value)) fail(item, "a coordinate is not a finite number (NaN or infinite)");
    return value;
  }
  std::int64_t whole(Type type, const Item& item) {
    const double value = next(type, item);
    if (!(std::fabs(value) <= 4294967295.0) || value != std::floor(value)) fail(item, "expected a whole number");
    return static_cast<std::int64_t>(value);
  }
  [[noreturn]] void fail(const Item& item, const std::string& what) const {
    if (encoding_ == Encoding::text) text_.fail(item, what);
    fail_at_byte(file_, begin_, name_of(item) + ": " + what, "repair this item, or export the file again",
                 facets_of(item));
  }
  /// Anything but blanks after the last element would be data that nobody reads.
  void expect_end() {
    if (encoding_ == Encoding::text) {
      if (!text_.at_end()) text_.fail({"end of the file"}, "more follows than the header says");
      return;
    }
    for (std::size_t i = byte_; i < file_.bytes.size(); ++i)
      if (static_cast<unsigned char>(file_.bytes[i]) > 32)
        fail_at_byte(file_, i, "more bytes follow than the header says", "the header is wrong: export the file again");
  }
  std::size_t remaining() const { return encoding_ == Encoding::text ? text_.remaining() : file_.bytes.size() - byte_; }

 private:
  static std::string name_of(const Item& item) { return std::string(item.kind) + " " + std::to_string(item.number); }
  static std::vector<long long> facets_of(const Item& item) {
    return item.kind == "facet" ? std::vector<long long>{item.number} : std::vector<long long>{};
  }
  template <class T>
  static double as(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }
  static double decoded(Type type, const char* bytes) {
    static_assert(std::endian::native == std::endian::little, "the bytes are in little-endian order here");
    if (type.kind == Type::real) return type.size == 4 ? as<float>(bytes) : as<double>(bytes);
    const bool negative_too = type.kind == Type::signed_integer;
    if (type.size == 1) return negative_too ? as<std::int8_t>(bytes) : as<std::uint8_t>(bytes);
    if (type.size == 2) return negative_too ? as<std::int16_t>(bytes) : as<std::uint16_t>(bytes);
    return negative_too ? as<std::int32_t>(bytes) : as<std::uint32_t>(bytes);
  }

  const FileBytes& file_;
  Encoding encoding_;
  std::size_t byte_, begin_ = 0;
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
  for (std::size_t k = 0; k < length; ++k) values.skip(property.type, item);
}

void read_vertex(Values& values, const Element& element, const Item& item, InputPlc& plc) {
  Point3 point;
  for (const Property& property : element.properties) {
    double* coordinate = property.list_count    ? nullptr
                         : property.name == "x" ? &point.x
                         : property.name == "y" ? &point.y
                         : property.name == "z" ? &point.z
                                                : nullptr;
    if (coordinate)
      *coordinate = values.coordinate(property.type, item);
    else
      skip_property(values, property, item);
  }
  plc.vertices.push_back(point);
}

bool is_corner_list(const Property& property) {
  return property.list_count && (property.name == "vertex_indices" || property.name == "vertex_index");
}

void read_face(Values& values, const Element& element, const Item& facet, std::size_t vertices, InputPlc& plc,
               std::vector<std::uint32_t>& corners) {
  int marker = 0;
  for (const Property& property : element.properties) {
    if (is_corner_list(property)) {
      corners.resize(list_length(values, property, facet));
      if (corners.size() < 3)
        values.fail(facet, "it has " + std::to_string(corners.size()) + " corners, but needs three");
      for (std::uint32_t& corner : corners) {
        const std::int64_t index = values.whole(property.type, facet);
        if (index < 0 || static_cast<std::size_t>(index) >= vertices)
          values.fail(facet, "vertex index " + std::to_string(index) + " is out of range: the file has " +
                                 std::to_string(vertices) + " vertices, counted from 0");
        corner = static_cast<std::uint32_t>(index);
      }
    } else if (property.name == "marker" && !property.list_count && property.type.kind != Type::real) {
      const std::int64_t value = values.whole(property.type, facet);
      if (value < INT_MIN || value > INT_MAX) values.fail(facet, "its marker does not fit 32 bits");
      marker = static_cast<int>(value);
    } else {
      skip_property(values, property, facet);
    }
  }
  add_facet(plc, corners, marker, static_cast<std::uint32_t>(facet.number));
}

void check_properties(const FileBytes& file, const Element& element) {
  const auto has = [&](auto wanted) {
    return std::any_of(element.properties.begin(), element.properties.end(), wanted);
  };
  if (element.name == "vertex")
    for (const char* axis : {"x", "y", "z"})
      if (!has([&](const Property& p) { return p.name == axis && !p.list_count; }))
        fail_at_byte(file, 0, std::string("vertices have no property '") + axis + "'", "export the file again");
  if (element.name == "face" && !has(is_corner_list))
    fail_at_byte(file, 0, "faces have no list 'vertex_indices' or 'vertex_index'", "export the file again");
}

}  // namespace

InputPlc read_ply(const FileBytes& file) {
  const Header header = read_header(file);
  check_counts(file, header);
  InputPlc plc;
  Values values(file, header);
  std::vector<std::uint32_t> corners;
  for (const Element& element : header.elements) {
    if (element.count == 0 || element.properties.empty()) continue;
    check_properties(file, element);
    for (std::size_t i = 0; i < element.count; ++i) {
      const std::int64_t number = static_cast<std::int64_t>(i);
      if (element.name == "vertex") {
        read_vertex(values, element, {"vertex", number}, plc);
      } else if (element.name == "face") {
        read_face(values, element, {"facet", number}, header.vertices(), plc, corners);
      } else {
        for (const Property& property : element.properties) skip_property(values, property, {"element", number});
      }
    }
  }
  values.expect_end();
  finish_facets(plc);
  return plc;
}

}  // namespace ccdt::io
