#include <algorithm>
#include <climits>
#include <cmath>
#include <map>
#include <optional>

#include "engine/io/formats.h"
#include "engine/io/text_scanner.h"

namespace ccdt::io {

namespace {

constexpr const char* remedy = "export the file again";
constexpr const char* outline_remedy = "export the file again as a VTK XML unstructured grid, uncompressed";

// VTK's types of cells
constexpr std::uint8_t vertex = 1, poly_vertex = 2, line = 3, triangle = 5, tetrahedron = 10;

struct XmlAttributes : std::map<std::string, std::string, std::less<>> {
  /// The value of an attribute; empty if there is none.
  std::string value(std::string_view name) const {
    const auto found = find(name);
    return found == end() ? std::string() : found->second;
  }
};

/// A DataArray of a VTK XML file, not yet decoded.
struct VtkArray {
  std::string parent;  ///< Points, Cells, CellData, PointData or FieldData
  XmlAttributes attributes;
  std::size_t begin = 0, end = 0;  ///< its text, if it has one, in the file's bytes
};

/// The outline of a .vtu file.
struct VtkOutline {
  XmlAttributes header;  ///< of VTKFile
  XmlAttributes piece;   ///< of Piece
  std::vector<VtkArray> arrays;
  std::string appended_encoding;  ///< raw, base64 or empty
  std::size_t appended_begin = 0, appended_end = 0;
};

struct XmlTag {
  std::string name;
  XmlAttributes attributes;
  bool closes = false, is_empty = false;  ///< </name> and <name/>
  std::size_t begin = 0, end = 0;         ///< from '<' to behind '>'
};

constexpr std::string_view blanks = " \t\r\n", name_ends = " \t\r\n=/<>\"'";

/// Goes from tag to tag; comments and <?...?> are skipped.
class XmlTags {
 public:
  explicit XmlTags(const FileBytes& file) : file_(file), text_(file.bytes) {}

  bool next(XmlTag& tag) {
    for (at_ = text_.find('<', at_); at_ != std::string_view::npos; at_ = text_.find('<', at_)) {
      const std::string_view rest = text_.substr(at_);
      if (!rest.starts_with("<?") && !rest.starts_with("<!")) break;
      at_ = find(rest.starts_with("<!--") ? "-->" : ">", at_);
    }
    if (at_ == std::string_view::npos) return false;
    tag = XmlTag{};
    tag.begin = at_++;
    tag.closes = accept('/');
    tag.name = name();
    while (!accept_end(tag)) {
      const std::string key = name();
      if (!accept('=')) fail("expected '=' after the attribute " + in_quotes(key));
      tag.attributes[key] = value();
    }
    tag.end = at_;
    return true;
  }

 private:
  void skip_blanks() {
    at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
    if (at_ == text_.size()) fail("the file is truncated: it ends within a tag");
  }
  bool accept(char c) {
    skip_blanks();
    if (text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool accept_end(XmlTag& tag) {
    tag.is_empty = accept('/');
    const bool ends = accept('>');
    if (tag.is_empty && !ends) fail("expected '>' after '/'");
    return ends;
  }
  std::string name() {
    skip_blanks();
    const std::size_t begin = at_;
    at_ = std::min(text_.find_first_of(name_ends, at_), text_.size());
    if (at_ == begin) fail("expected a name, found " + in_quotes(text_.substr(at_, 1)));
    return std::string(text_.substr(begin, at_ - begin));
  }
  std::string value() {
    skip_blanks();
    const char quote = text_[at_];
    if (quote != '"' && quote != '\'') fail("expected a value in quotes");
    const std::size_t begin = ++at_;
    at_ = find(std::string_view(&quote, 1), at_);
    return std::string(text_.substr(begin, at_ - 1 - begin));
  }
  /// Behind the next occurrence.
  std::size_t find(std::string_view what, std::size_t from) {
    const std::size_t found = text_.find(what, from);
    if (found == std::string_view::npos) fail("the file is truncated: it ends within a tag");
    return found + what.size();
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(what, line_of_byte(file_, std::min(at_, text_.size())), outline_remedy);
  }

  const FileBytes& file_;
  std::string_view text_;
  std::size_t at_ = 0;
};

void find_appended_data(const FileBytes& file, const XmlTag& tag, VtkOutline& outline) {
  outline.appended_encoding = tag.attributes.contains("encoding") ? tag.attributes.value("encoding") : "base64";
  const std::size_t underscore = file.bytes.find('_', tag.end);
  outline.appended_begin = underscore == std::string::npos ? file.bytes.size() : underscore + 1;
  outline.appended_end = file.bytes.rfind("</AppendedData");
  if (outline.appended_end == std::string::npos || outline.appended_end < outline.appended_begin)
    fail_at_byte(file, file.bytes.size(), "the file is truncated: its appended data have no end", outline_remedy);
}

void check_header(const FileBytes& file, const VtkOutline& outline) {
  if (outline.header.value("type") != "UnstructuredGrid")
    fail_at_byte(file, 0, "this is no VTK XML unstructured grid", outline_remedy);
  if (outline.header.contains("compressor"))
    fail_at_byte(file, 0, "its data are compressed, which is not supported", outline_remedy);
}

/// Reads the tags of an unstructured grid of one piece. \throw InputError
VtkOutline read_vtk_outline(const FileBytes& file) {
  VtkOutline outline;
  XmlTags tags(file);
  XmlTag tag;
  std::string parent;
  bool complete = false;
  VtkArray* open = nullptr;
  while (!complete && tags.next(tag)) {
    // An array's text ends with the next tag: its own end, or that of remarks which ParaView puts behind the numbers.
    if (open) open->end = tag.begin;
    open = nullptr;
    if (tag.closes) {
      complete = tag.name == "VTKFile";
    } else if (tag.name == "VTKFile") {
      outline.header = tag.attributes;
      check_header(file, outline);
    } else if (tag.name == "Piece") {
      if (!outline.piece.empty())
        fail_at_byte(file, tag.begin, "it has several pieces", "merge the pieces into one file");
      outline.piece = tag.attributes;
    } else if (tag.name == "DataArray") {
      outline.arrays.push_back({parent, tag.attributes, tag.end, tag.end});
      open = tag.is_empty ? nullptr : &outline.arrays.back();
    } else if (tag.name == "AppendedData") {
      find_appended_data(file, tag, outline);
      complete = true;  // what follows is data, which may look like tags
    } else if (tag.name.ends_with("Data") || tag.name == "Points" || tag.name == "Cells") {
      parent = tag.name;
    }
  }
  check_header(file, outline);
  if (!complete) fail_at_byte(file, file.bytes.size(), "the file is truncated: it has no </VTKFile>", outline_remedy);
  if (outline.piece.empty()) fail_at_byte(file, 0, "it has no Piece", outline_remedy);
  return outline;
}

/// Decodes base64. Padding may also stand in the middle, where two encoded pieces follow each other; blanks are
/// skipped. \return nothing if there is another character or a piece is incomplete
std::optional<std::string> decode_base64(std::string_view text) {
  static constexpr std::uint8_t bad = 255, padding = 254, blank = 253;
  static constexpr auto table = [] {
    std::array<std::uint8_t, 256> values{};
    values.fill(bad);
    std::uint8_t next = 0;
    for (const char c : std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"))
      values[static_cast<unsigned char>(c)] = next++;
    for (const char c : {' ', '\t', '\r', '\n'}) values[static_cast<unsigned char>(c)] = blank;
    values['='] = padding;
    return values;
  }();
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int digits = 0, padded = 0;
  for (const char c : text) {
    const std::uint8_t value = table[static_cast<unsigned char>(c)];
    if (value == blank) continue;
    if (value == bad || (value == padding && digits < 2) || (value != padding && padded > 0)) return std::nullopt;
    padded += value == padding;
    bits = bits << 6 | (value == padding ? 0u : value);
    if (++digits < 4) continue;
    for (int k = 0; k < 3 - padded; ++k) bytes += static_cast<char>(bits >> (16 - 8 * k) & 255);
    bits = 0;
    digits = padded = 0;
  }
  return digits == 0 ? std::optional(std::move(bytes)) : std::nullopt;
}

template <class Stored, class Value>
std::vector<Value> convert(std::string_view bytes, bool big_endian) {
  std::vector<Value> values(bytes.size() / sizeof(Stored));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Stored stored = number_at<Stored>(bytes.data() + i * sizeof(Stored), big_endian);
    if constexpr (std::is_floating_point_v<Stored> && std::is_integral_v<Value>)
      values[i] = std::fabs(stored) < 9e18 ? static_cast<Value>(stored) : -1;  // -1 is no index and no cell type
    else
      values[i] = static_cast<Value>(stored);
  }
  return values;
}

template <class Value>
constexpr std::pair<const char*, std::vector<Value> (*)(std::string_view, bool)> converters[] = {
    {"Float32", convert<float, Value>},      {"Float64", convert<double, Value>},
    {"Int8", convert<std::int8_t, Value>},   {"UInt8", convert<std::uint8_t, Value>},
    {"Int16", convert<std::int16_t, Value>}, {"UInt16", convert<std::uint16_t, Value>},
    {"Int32", convert<std::int32_t, Value>}, {"UInt32", convert<std::uint32_t, Value>},
    {"Int64", convert<std::int64_t, Value>}, {"UInt64", convert<std::uint64_t, Value>},
};

/// Reads the arrays of a file: from text, base64 or appended bytes, of any type and byte order.
class VtuArrays {
 public:
  explicit VtuArrays(const FileBytes& file)
      : file_(file),
        outline_(read_vtk_outline(file)),
        big_endian_(outline_.header.value("byte_order") == "BigEndian") {}

  /// \param name  empty: any. \return null if there is none
  const VtkArray* find(std::string_view parent, std::string_view name) const {
    for (const VtkArray& array : outline_.arrays)
      if (array.parent == parent && (name.empty() || array.attributes.value("Name") == name)) return &array;
    return nullptr;
  }
  const VtkArray& required(const std::string& parent, const std::string& name) const {
    const VtkArray* array = find(parent, name);
    if (!array) fail(0, "it has no array " + in_quotes(name.empty() ? parent : name) + " in " + parent);
    return *array;
  }

  /// A count that the Piece claims.
  std::size_t claimed(const std::string& name) const {
    const std::string text = outline_.piece.value(name);
    if (text.empty() || text.size() > 10 || text.find_first_not_of("0123456789") != std::string::npos)
      fail(0, name + " is " + in_quotes(text) + ", not a number below 2^32");
    return std::stoull(text);
  }

  void check_size(const VtkArray& array, std::size_t found, std::size_t due) const {
    if (found != due)
      fail(array.begin,
           "array " + in_quotes(array.attributes.value("Name")) + " has " + std::to_string(found) + " values, not " +
               std::to_string(due),
           "the file is damaged: export it again");
  }

  /// The numbers of an array. Value is double or std::int64_t.
  template <class Value>
  std::vector<Value> read(const VtkArray& array) const {
    const std::string type = array.attributes.value("type"), format = array.attributes.value("format");
    if (format.empty() || format == "ascii") return read_text<Value>(array);
    std::string decoded;
    const std::string_view bytes = bytes_of(array, decoded);
    for (const auto& [name, convert_bytes] : converters<Value>)
      if (type == name) return convert_bytes(bytes, big_endian_);
    fail(array.begin, name_of(array) + ": unknown type " + in_quotes(type));
  }

  [[noreturn]] void fail(std::size_t byte, const std::string& what, const std::string& what_to_do = remedy) const {
    fail_at_byte(file_, byte, what, what_to_do);
  }

 private:
  static std::string name_of(const VtkArray& array) {
    const std::string name = array.attributes.value("Name");
    return "array " + in_quotes(name.empty() ? array.parent : name);
  }
  static bool is_appended(const VtkArray& array) { return array.attributes.value("format") == "appended"; }

  std::size_t appended_begin(const VtkArray& array) const {
    const std::string offset = array.attributes.value("offset");
    char* stop = nullptr;
    const unsigned long long value = std::strtoull(offset.c_str(), &stop, 10);
    if (offset.empty() || *stop != 0 || value > outline_.appended_end - outline_.appended_begin)
      fail(array.begin, name_of(array) + ": its offset " + in_quotes(offset) + " is not within the appended data");
    return outline_.appended_begin + static_cast<std::size_t>(value);
  }

  /// \param decoded  keeps the bytes if they have to be decoded
  std::string_view bytes_of(const VtkArray& array, std::string& decoded) const {
    const bool appended = is_appended(array);
    const std::size_t begin = appended ? appended_begin(array) : array.begin;
    std::size_t end = appended ? outline_.appended_end : array.end;
    if (appended && outline_.appended_encoding != "base64")
      return without_length(array, std::string_view(file_.bytes).substr(begin, end - begin), begin);
    // Appended arrays follow each other; this one's end is where its padding or the next offset is.
    for (const VtkArray& other : outline_.arrays)
      if (appended && is_appended(other) && appended_begin(other) > begin) end = std::min(end, appended_begin(other));
    std::optional<std::string> bytes = decode_base64(std::string_view(file_.bytes).substr(begin, end - begin));
    if (!bytes) fail(begin, name_of(array) + " is not valid base64");
    decoded = std::move(*bytes);
    return without_length(array, decoded, begin);
  }

  /// Cuts the length, which comes first, off the bytes, and what follows behind the array.
  std::string_view without_length(const VtkArray& array, std::string_view bytes, std::size_t begin) const {
    const std::size_t size = outline_.header.value("header_type") == "UInt64" ? 8 : 4;
    if (bytes.size() < size) fail(begin, "the file is truncated: " + name_of(array) + " has no length");
    const std::uint64_t length = size == 8 ? number_at<std::uint64_t>(bytes.data(), big_endian_)
                                           : number_at<std::uint32_t>(bytes.data(), big_endian_);
    if (length > bytes.size() - size)
      fail(begin,
           name_of(array) + " claims " + std::to_string(length) + " bytes, but only " +
               std::to_string(bytes.size() - size) + " bytes follow",
           "the file is truncated or its header is wrong: export it again");
    return bytes.substr(size, length);
  }

  template <class Value>
  std::vector<Value> read_text(const VtkArray& array) const {
    std::vector<Value> values;
    TextScanner in(file_, TextScanner::no_comments, array.begin, array.end);
    const std::string name = name_of(array);
    while (!in.at_end()) {
      if constexpr (std::is_integral_v<Value>)
        values.push_back(in.integer(std::string_view(name)));
      else
        values.push_back(in.number(std::string_view(name)));
    }
    return values;
  }

  const FileBytes& file_;
  VtkOutline outline_;
  bool big_endian_;
};

std::vector<Point3> read_points(const VtuArrays& arrays) {
  const VtkArray& array = arrays.required("Points", "");
  const auto xyz = arrays.read<double>(array);
  arrays.check_size(array, xyz.size(), 3 * arrays.claimed("NumberOfPoints"));
  std::vector<Point3> points(xyz.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y) || !std::isfinite(points[i].z))
      arrays.fail(array.begin,
                  "vertex " + std::to_string(i) + ": a coordinate is not a finite number (NaN or infinite)",
                  "repair this vertex, or export the file again");
  }
  return points;
}

struct VtuCells {
  const VtuArrays& arrays;
  std::size_t vertices = 0;
  std::vector<std::int64_t> connectivity, offsets, types, regions, markers;

  template <std::size_t Corners>
  void add(std::size_t cell, const std::vector<std::int64_t>& attributes,
           std::vector<std::array<std::uint32_t, Corners>>& elements, std::vector<int>& element_attributes) const {
    const std::int64_t begin = cell == 0 ? 0 : offsets[cell - 1], end = offsets[cell];
    const auto refuse = [&](const std::string& what) { arrays.fail(0, "cell " + std::to_string(cell) + ": " + what); };
    if (begin < 0 || end < begin || end - begin != static_cast<std::int64_t>(Corners) ||
        static_cast<std::size_t>(end) > connectivity.size())
      refuse("its offsets " + std::to_string(begin) + " and " + std::to_string(end) + " are wrong");
    std::array<std::uint32_t, Corners> corners;
    for (std::size_t k = 0; k < Corners; ++k) {
      const std::int64_t index = connectivity[static_cast<std::size_t>(begin) + k];
      if (index < 0 || static_cast<std::size_t>(index) >= vertices)
        refuse("vertex index " + std::to_string(index) + " is out of range: the file has " + std::to_string(vertices) +
               " vertices, counted from 0");
      corners[k] = static_cast<std::uint32_t>(index);
    }
    elements.push_back(corners);
    element_attributes.push_back(attributes.empty() ? 0 : static_cast<int>(attributes[cell]));
  }
};

VtuCells read_cells(const VtuArrays& arrays, std::size_t vertices) {
  const std::size_t count = arrays.claimed("NumberOfCells");
  const auto read = [&](const char* name) { return arrays.read<std::int64_t>(arrays.required("Cells", name)); };
  // Attributes of cells by name, or nothing if there is no such array of one whole number a cell.
  const auto read_attributes = [&](const std::string& name) {
    const VtkArray* array = arrays.find("CellData", name);
    if (!array) return std::vector<std::int64_t>();
    auto values = arrays.read<std::int64_t>(*array);
    arrays.check_size(*array, values.size(), count);
    for (std::size_t i = 0; i < count; ++i)
      if (values[i] < INT_MIN || values[i] > INT_MAX)
        arrays.fail(array->begin, "cell " + std::to_string(i) + ": its " + name + " does not fit 32 bits",
                    "use smaller numbers");
    return values;
  };
  VtuCells cells{arrays, vertices, read("connectivity"), read("offsets"), read("types"), {}, {}};
  arrays.check_size(arrays.required("Cells", "offsets"), cells.offsets.size(), count);
  arrays.check_size(arrays.required("Cells", "types"), cells.types.size(), count);
  cells.regions = read_attributes("region");
  cells.markers = read_attributes("marker");
  return cells;
}

/// Declares the arrays, which are appended behind the XML, each with its length in bytes before it.
void write_outline(const mesh::TetMesh& mesh, std::size_t cells, std::size_t corners, OutputFile& out) {
  std::size_t offset = 0;
  const auto declare = [&](const char* type, const char* name, std::size_t bytes, const char* more = "") {
    out << "        <DataArray type=\"" << type << "\" Name=\"" << name << "\"" << more
        << " format=\"appended\" offset=\"" << offset << "\"/>\n";
    offset += sizeof(std::uint64_t) + bytes;
  };
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n  <UnstructuredGrid>\n    <FieldData>\n      <DataArray type=\"Int32\" "
         "Name=\"constrained_delaunay\" NumberOfTuples=\"1\" format=\"ascii\">"
      << (mesh.constrained_delaunay ? 1 : 0) << "</DataArray>\n    </FieldData>\n    <Piece NumberOfPoints=\""
      << mesh.vertices.size() << "\" NumberOfCells=\"" << cells << "\">\n      <Points>\n";
  declare("Float64", "Points", 24 * mesh.vertices.size(), " NumberOfComponents=\"3\"");
  out << "      </Points>\n      <Cells>\n";
  declare("Int64", "connectivity", 8 * corners);
  declare("Int64", "offsets", 8 * cells);
  declare("UInt8", "types", cells);
  out << "      </Cells>\n      <CellData Scalars=\"region\">\n";
  declare("Int32", "region", 4 * cells);
  declare("Int32", "marker", 4 * cells);
  out << "      </CellData>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_";
}

}  // namespace

mesh::TetMesh read_vtu(const FileBytes& file) {
  const VtuArrays arrays(file);
  mesh::TetMesh mesh;
  mesh.vertices = read_points(arrays);
  const VtuCells cells = read_cells(arrays, mesh.vertices.size());
  for (std::size_t i = 0; i < cells.types.size(); ++i) {
    const std::int64_t type = cells.types[i];
    if (type == tetrahedron)
      cells.add(i, cells.regions, mesh.tetrahedra, mesh.regions);
    else if (type == triangle)
      cells.add(i, cells.markers, mesh.faces, mesh.face_markers);
    else if (type == line)
      cells.add(i, cells.markers, mesh.edges, mesh.edge_markers);
    else if (type != vertex && type != poly_vertex)
      arrays.fail(0, "cell " + std::to_string(i) + ": cells of type " + std::to_string(type) + " are not supported",
                  "write linear tetrahedra, triangles and lines only");
  }
  if (const VtkArray* claim = arrays.find("FieldData", "constrained_delaunay"))
    mesh.constrained_delaunay = arrays.read<std::int64_t>(*claim) == std::vector<std::int64_t>{1};
  return mesh;
}

/// Tetrahedra come first, then the faces and edges on facets and segments. `region` is of the tetrahedra, `marker` of
/// the others; each is 0 where the other one counts.
void write_vtu(const mesh::TetMesh& mesh, OutputFile& out) {
  const std::size_t tetrahedra = mesh.tetrahedra.size(), faces = mesh.faces.size(), edges = mesh.edges.size();
  const std::size_t cells = tetrahedra + faces + edges, corners = 4 * tetrahedra + 3 * faces + 2 * edges;
  const auto begin_array = [&](std::size_t bytes) { out.raw(static_cast<std::uint64_t>(bytes)); };
  /// Calls write(elements, type, attributes) for each kind of element.
  const auto for_each_kind = [&](const auto& write) {
    write(mesh.tetrahedra, tetrahedron, mesh.regions);
    write(mesh.faces, triangle, mesh.face_markers);
    write(mesh.edges, line, mesh.edge_markers);
  };
  write_outline(mesh, cells, corners, out);
  begin_array(24 * mesh.vertices.size());
  for (const Point3& p : mesh.vertices) out.raw(p.x).raw(p.y).raw(p.z);
  begin_array(8 * corners);
  for_each_kind([&](const auto& elements, std::uint8_t, const auto&) {
    for (const auto& element : elements)
      for (const std::uint32_t v : element) out.raw(static_cast<std::int64_t>(v));
  });
  begin_array(8 * cells);
  std::int64_t offset = 0;
  for_each_kind([&](const auto& elements, std::uint8_t, const auto&) {
    for (const auto& element : elements) out.raw(offset += static_cast<std::int64_t>(element.size()));
  });
  begin_array(cells);
  for_each_kind([&](const auto& elements, std::uint8_t type, const auto&) {
    for (std::size_t i = 0; i < elements.size(); ++i) out.raw(type);
  });
  for (const bool regions : {true, false}) {
    begin_array(4 * cells);
    for_each_kind([&](const auto& elements, std::uint8_t type, const auto& attributes) {
      for (std::size_t i = 0; i < elements.size(); ++i)
        out.raw(static_cast<std::int32_t>((type == tetrahedron) == regions ? attribute_of(attributes, i) : 0));
    });
  }
  out << "\n  </AppendedData>\n</VTKFile>\n";
}

}  // namespace ccdt::io
