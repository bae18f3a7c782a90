#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>

#include "engine/io/base64.h"
#include "engine/io/text_scanner.h"
#include "engine/io/vtk_xml.h"

namespace ccdt::io {

namespace {

constexpr const char* remedy = "export the file again";

std::string name_of(const VtkArray& array) {
  const std::string name = array.attribute("Name");
  return "array " + in_quotes(name.empty() ? array.parent : name);
}

/// The bytes of an array and where they are in the file (for base64: where its text begins).
struct ArrayBytes {
  std::string_view bytes;
  std::string decoded;  ///< keeps them, if they had to be decoded
  std::size_t at = 0;
};

bool is_swapped(const VtkFile& outline) {
  static_assert(std::endian::native == std::endian::little);
  const auto order = outline.header.find("byte_order");
  return order != outline.header.end() && order->second == "BigEndian";
}

std::uint64_t read_length(std::string_view bytes, std::size_t size, bool swapped) {
  char digits[8] = {};
  std::memcpy(digits, bytes.data(), size);
  if (swapped) std::reverse(digits, digits + size);
  std::uint64_t length;
  std::memcpy(&length, digits, sizeof length);
  return length;
}

/// Cuts the length, which comes first, off the bytes, and what follows behind the array.
void strip_length(const FileBytes& file, const VtkFile& outline, const VtkArray& array, ArrayBytes& data) {
  const auto type = outline.header.find("header_type");
  const std::size_t size = type != outline.header.end() && type->second == "UInt64" ? 8 : 4;
  const std::size_t available = data.bytes.size();
  if (available < size)
    fail_at_byte(file, data.at, "the file is truncated: " + name_of(array) + " has no length", remedy);
  const std::uint64_t length = read_length(data.bytes, size, is_swapped(outline));
  if (length > available - size)
    fail_at_byte(file, data.at,
                 name_of(array) + " claims " + std::to_string(length) + " bytes, but only " +
                     std::to_string(available - size) + " bytes follow",
                 "the file is truncated or its header is wrong: export it again");
  data.bytes = data.bytes.substr(size, length);
}

std::size_t offset_of(const FileBytes& file, const VtkFile& outline, const VtkArray& array) {
  const std::string offset = array.attribute("offset");
  char* stop = nullptr;
  const unsigned long long value = std::strtoull(offset.c_str(), &stop, 10);
  if (offset.empty() || *stop != 0 || value > outline.appended_end - outline.appended_begin)
    fail_at_byte(file, array.begin,
                 name_of(array) + ": its offset " + in_quotes(offset) + " is not within the appended data", remedy);
  return static_cast<std::size_t>(value);
}

void find_bytes(const FileBytes& file, const VtkFile& outline, const VtkArray& array, ArrayBytes& data) {
  const std::string_view all = file.bytes;
  const bool is_appended = array.attribute("format") == "appended";
  std::size_t begin = array.begin, end = array.end;
  if (is_appended) {
    begin = outline.appended_begin + offset_of(file, outline, array);
    end = outline.appended_end;
  }
  data.at = begin;
  data.bytes = all.substr(begin, end - begin);
  if (!is_appended || outline.appended_encoding == "base64") {
    // Appended arrays follow each other; this one's end is where its padding or the next offset is.
    for (const VtkArray& other : outline.arrays) {
      if (!is_appended || other.attribute("format") != "appended") continue;
      const std::size_t next = outline.appended_begin + offset_of(file, outline, other);
      if (next > begin) data.bytes = data.bytes.substr(0, std::min(data.bytes.size(), next - begin));
    }
    std::optional<std::string> decoded = decode_base64(data.bytes);
    if (!decoded) fail_at_byte(file, begin, name_of(array) + " is not valid base64", remedy);
    data.decoded = std::move(*decoded);
    data.bytes = data.decoded;
  }
  strip_length(file, outline, array, data);
}

template <class Stored, class Value>
void convert(std::string_view bytes, bool swapped, std::vector<Value>& values) {
  values.resize(bytes.size() / sizeof(Stored));
  for (std::size_t i = 0; i < values.size(); ++i) {
    char digits[sizeof(Stored)];
    std::memcpy(digits, bytes.data() + i * sizeof(Stored), sizeof(Stored));
    if (swapped) std::reverse(digits, digits + sizeof(Stored));
    Stored stored;
    std::memcpy(&stored, digits, sizeof stored);
    if constexpr (std::is_floating_point_v<Stored> && std::is_integral_v<Value>)
      values[i] = std::fabs(stored) < 9e18 ? static_cast<Value>(stored) : -1;  // -1 is no index and no cell type
    else
      values[i] = static_cast<Value>(stored);
  }
}

template <class Value>
using Converter = void (*)(std::string_view, bool, std::vector<Value>&);

template <class Value>
struct TypeEntry {
  const char* name;
  Converter<Value> convert;
};

template <class Value>
constexpr TypeEntry<Value> types[] = {
    {"Float32", convert<float, Value>},      {"Float64", convert<double, Value>},
    {"Int8", convert<std::int8_t, Value>},   {"UInt8", convert<std::uint8_t, Value>},
    {"Int16", convert<std::int16_t, Value>}, {"UInt16", convert<std::uint16_t, Value>},
    {"Int32", convert<std::int32_t, Value>}, {"UInt32", convert<std::uint32_t, Value>},
    {"Int64", convert<std::int64_t, Value>}, {"UInt64", convert<std::uint64_t, Value>},
};

template <class Value>
std::vector<Value> read_text_array(const FileBytes& file, const VtkArray& array) {
  std::vector<Value> values;
  TextScanner in(file, TextScanner::no_comments, array.begin, array.end);
  const std::string name = name_of(array);
  while (!in.at_end()) {
    if constexpr (std::is_integral_v<Value>)
      values.push_back(in.integer({name}));
    else
      values.push_back(in.number({name}));
  }
  return values;
}

}  // namespace

template <class Value>
std::vector<Value> read_vtk_array(const FileBytes& file, const VtkFile& outline, const VtkArray& array) {
  const std::string type = array.attribute("type"), format = array.attribute("format");
  if (format.empty() || format == "ascii") return read_text_array<Value>(file, array);
  ArrayBytes data;
  find_bytes(file, outline, array, data);
  std::vector<Value> values;
  for (const auto& entry : types<Value>)
    if (type == entry.name) {
      entry.convert(data.bytes, is_swapped(outline), values);
      return values;
    }
  fail_at_byte(file, array.begin, name_of(array) + ": unknown type " + in_quotes(type), remedy);
}

template std::vector<double> read_vtk_array(const FileBytes&, const VtkFile&, const VtkArray&);
template std::vector<std::int64_t> read_vtk_array(const FileBytes&, const VtkFile&, const VtkArray&);

}  // namespace ccdt::io
