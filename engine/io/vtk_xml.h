#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/io/file_bytes.h"

namespace ccdt::io {

/// A DataArray of a VTK XML file, not yet decoded.
struct VtkArray {
  std::string parent;  ///< Points, Cells, CellData, PointData or FieldData
  std::map<std::string, std::string> attributes;
  std::size_t begin = 0, end = 0;  ///< its text, if it has one, in the file's bytes

  std::string attribute(const std::string& name) const {
    const auto found = attributes.find(name);
    return found == attributes.end() ? std::string() : found->second;
  }
};

/// The outline of a .vtu file.
struct VtkFile {
  std::map<std::string, std::string> header;  ///< attributes of VTKFile
  std::map<std::string, std::string> piece;   ///< attributes of Piece
  std::vector<VtkArray> arrays;
  std::string appended_encoding;  ///< raw, base64 or empty
  std::size_t appended_begin = 0, appended_end = 0;

  const VtkArray* find(std::string_view parent, std::string_view name) const;
};

/// Reads the tags of an unstructured grid of one piece.
/// \throw InputError
VtkFile read_vtk_outline(const FileBytes& file);

/// The numbers of an array, from text, base64 or appended bytes, of any type and byte order.
/// Value is double or std::int64_t. \throw InputError
template <class Value>
std::vector<Value> read_vtk_array(const FileBytes& file, const VtkFile& outline, const VtkArray& array);

}  // namespace ccdt::io
