#include "engine/io/vtk_arrays.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/io/text_scanner.h"
#include "engine/io/vtk_bytes.h"

namespace ccdt::io {

namespace {

constexpr const char* outline_remedy = "export the file again in the format of its extension: VTK XML";

/// Where the tag of the appended data begins. What follows it is data, which may look like tags.
constexpr std::string_view appended_tag = "<AppendedData", appended_end_tag = "</AppendedData";

template <class Stored, class Value>
void convert(const char* bytes, std::size_t count, bool big_endian, Value* values) {
  for (std::size_t i = 0; i < count; ++i) {
    const Stored stored = number_at<Stored>(bytes + i * sizeof(Stored), big_endian);
    if constexpr (std::is_floating_point_v<Stored> && std::is_integral_v<Value>)
      values[i] = std::fabs(stored) < 9e18 ? static_cast<Value>(stored) : -1;  // -1 is neither an index nor a cell type
    else
      values[i] = static_cast<Value>(stored);
  }
}

template <class Value>
struct StoredType {
  std::string_view name;
  std::size_t bytes;
  typename StoredNumbers<Value>::Convert convert_all;
};

template <class Value>
constexpr StoredType<Value> stored_types[] = {
    {"Float32", 4, convert<float, Value>},      {"Float64", 8, convert<double, Value>},
    {"Int8", 1, convert<std::int8_t, Value>},   {"UInt8", 1, convert<std::uint8_t, Value>},
    {"Int16", 2, convert<std::int16_t, Value>}, {"UInt16", 2, convert<std::uint16_t, Value>},
    {"Int32", 4, convert<std::int32_t, Value>}, {"UInt32", 4, convert<std::uint32_t, Value>},
    {"Int64", 8, convert<std::int64_t, Value>}, {"UInt64", 8, convert<std::uint64_t, Value>},
};

/// The numbers of a text, in this machine's representation.
template <class Value>
StoredNumbers<Value> stored(std::span<const Value> values) {
  const auto bytes = std::as_bytes(values);
  StoredNumbers<Value> numbers{.bytes_each = sizeof(Value), .convert = convert<Value, Value>};
  numbers.bytes.resize(bytes.size());
  std::ranges::transform(bytes, numbers.bytes.begin(), [](std::byte b) { return static_cast<char>(b); });
  return numbers;
}

std::string_view xml_attribute(pugi::xml_node node, const char* name) {
  return node.attribute(name).value();
}

std::string name_of(pugi::xml_node array) {
  const std::string_view name = xml_attribute(array, "Name");
  return "array " + in_quotes(name.empty() ? array.parent().name() : name);
}

bool is_appended(pugi::xml_node array) {
  return xml_attribute(array, "format") == "appended";
}

}  // namespace

VtkArrays::VtkArrays(const FileBytes& file, const char* type) : file_(file) {
  load_outline();
  header_ = document_.child("VTKFile");
  if (xml_attribute(header_, "type") != type)
    fail(0, "this is not a VTK XML file of the type " + std::string(type), outline_remedy);
  piece_ = header_.child(type).child("Piece");
  if (!piece_) fail(0, "it has no Piece", outline_remedy);
  if (piece_.next_sibling("Piece"))
    fail(static_cast<std::size_t>(piece_.next_sibling("Piece").offset_debug()), "it has several pieces",
         "merge the pieces into one file");
  big_endian_ = xml_attribute(header_, "byte_order") == "BigEndian";
  length_size_ = xml_attribute(header_, "header_type") == "UInt64" ? 8 : 4;
}

/// Parses the XML up to the appended data.
void VtkArrays::load_outline() {
  std::string_view xml = file_.bytes;
  std::string closed;
  if (const std::size_t tag = xml.find(appended_tag); tag != std::string_view::npos) {
    const std::size_t data = xml.find('>', tag), underscore = xml.find('_', data);
    appended_end_ = xml.rfind(appended_end_tag);
    if (underscore >= appended_end_ || appended_end_ == std::string_view::npos)
      fail(xml.size(), "the file is truncated: its appended data have no end", outline_remedy);
    appended_begin_ = underscore + 1;
    closed = std::string(xml.substr(0, data + 1));
    if (!closed.ends_with("/>")) closed += "</AppendedData>";
    xml = closed += "</VTKFile>";
  }
  const auto result = document_.load_buffer(xml.data(), xml.size(), pugi::parse_escapes, pugi::encoding_utf8);
  if (!result)
    throw InputError(std::string("this is not XML, or the file is truncated: ") + result.description(),
                     line_of_byte(file_, static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0))),
                     outline_remedy);
  appended_ = document_.child("VTKFile").child("AppendedData");
}

VtkArrays::Array VtkArrays::find(const char* parent, std::string_view name) const {
  for (const Array& array : all(parent))
    if (name.empty() || xml_attribute(array, "Name") == name) return array;
  return {};
}

std::vector<VtkArrays::Array> VtkArrays::all(const char* parent) const {
  std::vector<Array> arrays;
  for (const pugi::xml_node place : {piece_, piece_.parent()})
    for (const Array array : place.child(parent).children("DataArray")) arrays.push_back(array);
  return arrays;
}

VtkArrays::Array VtkArrays::required(const char* parent, std::string_view name) const {
  const Array array = find(parent, name);
  if (!array) fail(0, "it has no array " + in_quotes(name.empty() ? parent : name) + " in " + parent);
  return array;
}

std::size_t VtkArrays::claimed(const char* name) const {
  const std::string_view text = xml_attribute(piece_, name);
  const std::optional<std::uint32_t> count = parse_whole<std::uint32_t>(text);
  if (!count) fail(0, name + (" is " + in_quotes(text)) + ", not a number below 2^32");
  return *count;
}

void VtkArrays::check_size(Array array, std::size_t found, std::size_t due) const {
  if (found != due)
    fail(begin_of(array),
         "array " + in_quotes(xml_attribute(array, "Name")) + " has " + std::to_string(found) + " values, not " +
             std::to_string(due),
         "the file is damaged: export it again");
}

template <class Value>
StoredNumbers<Value> VtkArrays::read(Array array) const {
  const std::string_view type = xml_attribute(array, "type"), format = xml_attribute(array, "format");
  if (format.empty() || format == "ascii") {
    std::vector<Value> values;
    const std::string_view text = text_of(array);
    const std::size_t begin = begin_of(array);
    TextScanner in(file_, TextScanner::no_comments, begin, begin + text.size());
    const std::string name = name_of(array);
    while (!in.at_end()) {
      if constexpr (std::is_integral_v<Value>)
        values.push_back(in.integer(std::string_view(name)));
      else
        values.push_back(in.number(std::string_view(name)));
    }
    return stored<Value>(values);
  }
  for (const auto& [name, bytes, convert_all] : stored_types<Value>)
    if (type == name) return {bytes_of(array), bytes, convert_all, big_endian_};
  fail(begin_of(array), name_of(array) + ": unknown type " + in_quotes(type));
}

template StoredNumbers<double> VtkArrays::read<double>(Array array) const;
template StoredNumbers<std::int64_t> VtkArrays::read<std::int64_t>(Array array) const;

/// An array's text ends at the next tag: its own end tag, or the metadata that ParaView puts after the numbers.
std::string_view VtkArrays::text_of(Array array) const {
  const pugi::xml_node text = array.first_child();
  return text.type() == pugi::node_pcdata ? text.value() : std::string_view();
}

std::size_t VtkArrays::begin_of(Array array) const {
  const pugi::xml_node text = array.first_child();
  const pugi::xml_node place = text.type() == pugi::node_pcdata ? text : array;
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(place.offset_debug(), 0));
}

std::size_t VtkArrays::appended_begin(Array array) const {
  const std::string_view offset = xml_attribute(array, "offset");
  const std::optional<std::uint64_t> value = parse_whole<std::uint64_t>(offset);
  if (!value || *value > appended_end_ - appended_begin_)
    fail(begin_of(array), name_of(array) + ": its offset " + in_quotes(offset) + " is not within the appended data");
  return appended_begin_ + static_cast<std::size_t>(*value);
}

/// The bytes of an array as they are in the file, perhaps with some bytes that follow it.
std::string_view VtkArrays::encoded_bytes(Array array) const {
  if (!is_appended(array)) return text_of(array);
  const std::size_t begin = appended_begin(array);
  std::size_t end = appended_end_;
  // Appended arrays are consecutive; in base64, this one ends at its padding or at the next offset.
  for (const pugi::xml_node place : {piece_, piece_.parent()})
    for (const pugi::xml_node group : place.children())
      for (const Array other : group.children("DataArray"))
        if (is_appended(other) && appended_begin(other) > begin) end = std::min(end, appended_begin(other));
  return std::string_view(file_.bytes).substr(begin, end - begin);
}

RawVector<char> VtkArrays::bytes_of(Array array) const {
  const std::string_view compressor = xml_attribute(header_, "compressor");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
    fail(0, "its data are compressed by " + in_quotes(compressor) + ", which is not supported",
         "export the file again, compressed by zlib or not compressed");
  const std::string_view encoded = encoded_bytes(array);
  std::string decoded;
  std::string_view bytes = encoded;
  if (!is_appended(array) || xml_attribute(appended_, "encoding") != "raw") {
    std::optional<std::string> binary = decode_base64(encoded);
    if (!binary) fail(begin_of(array), name_of(array) + " is not valid base64");
    decoded = std::move(*binary);
    bytes = decoded;
  }
  return compressor.empty() ? without_length(array, bytes) : decompressed(array, bytes);
}

/// One of the numbers before the bytes of an array.
std::uint64_t VtkArrays::length_at(std::string_view bytes, std::size_t index, Array array) const {
  if (bytes.size() / length_size_ <= index)
    fail(begin_of(array), "the file is truncated: " + name_of(array) + " has no length");
  const char* at = bytes.data() + index * length_size_;
  return length_size_ == 8 ? number_at<std::uint64_t>(at, big_endian_) : number_at<std::uint32_t>(at, big_endian_);
}

/// Removes the length before the bytes of an array, and what follows them.
RawVector<char> VtkArrays::without_length(Array array, std::string_view bytes) const {
  const std::uint64_t length = length_at(bytes, 0, array);
  bytes.remove_prefix(length_size_);
  if (length > bytes.size())
    fail(begin_of(array),
         name_of(array) + " claims " + std::to_string(length) + " bytes, but only " + std::to_string(bytes.size()) +
             " bytes follow",
         "the file is truncated or its header is wrong: export it again");
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)};
}

/// Decompresses bytes in the layout of `CompressedBlocks`.
RawVector<char> VtkArrays::decompressed(Array array, std::string_view bytes) const {
  const std::uint64_t blocks = length_at(bytes, 0, array);
  if (blocks == 0) return {};
  const std::uint64_t whole = length_at(bytes, 1, array), rest = length_at(bytes, 2, array);
  if (blocks > bytes.size() / length_size_ || 3 + blocks > bytes.size() / length_size_)
    fail(begin_of(array),
         name_of(array) + " claims " + std::to_string(blocks) + " compressed blocks, which its " +
             std::to_string(bytes.size()) + " bytes cannot hold",
         "the file is truncated or its header is wrong: export it again");
  struct Block {
    std::string_view compressed;
    std::size_t begin, size;
  };
  std::vector<Block> found;  // up to the first one that cannot be right
  std::size_t at = (3 + static_cast<std::size_t>(blocks)) * length_size_, size = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::uint64_t compressed = length_at(bytes, 3 + i, array), due = i + 1 == blocks && rest > 0 ? rest : whole;
    if (compressed > bytes.size() - at || !may_hold(compressed, due)) break;
    found.push_back({bytes.substr(at, compressed), size, static_cast<std::size_t>(due)});
    at += static_cast<std::size_t>(compressed);
    size += static_cast<std::size_t>(due);
  }
  RawVector<char> result(size);
  const auto bad = parallel_select(found.size(), 1, [&](std::size_t i) {
    return !decompress_block(found[i].compressed, {result.data() + found[i].begin, found[i].size});
  });
  if (const std::size_t first = bad.empty() ? found.size() : bad.front(); first < blocks)
    fail(begin_of(array), name_of(array) + ": block " + std::to_string(first) + " of its compressed data is damaged");
  return result;
}

void VtkArrays::fail(std::size_t byte, const std::string& what, const std::string& remedy) const {
  fail_at_byte(file_, byte, what, remedy);
}

}  // namespace ccdt::io
