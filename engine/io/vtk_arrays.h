#pragma once

#include <cstdint>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/raw_vector.h"
#include "engine/io/files.h"

namespace ccdt::io {

/// The numbers of an array as the file stores them. They are converted where they are read, so that no second array is
/// needed. Value is double or std::int64_t.
template <class Value>
struct StoredNumbers {
  using Convert = void (*)(const char* bytes, std::size_t count, bool big_endian, Value* values);

  RawVector<char> bytes = {};
  std::size_t bytes_each = 1;
  Convert convert = nullptr;
  bool big_endian = false;

  std::size_t size() const { return bytes.size() / bytes_each; }
  void read(std::size_t begin, std::size_t end, Value* values) const {
    if (begin < end) convert(bytes.data() + begin * bytes_each, end - begin, big_endian, values);
  }
};

/// The arrays of a VTK XML file of one piece: as text, in base64 or appended, with or without zlib
/// compression, of any type and byte order, with 32-bit or 64-bit lengths.
class VtkArrays {
 public:
  using Array = pugi::xml_node;  ///< a DataArray

  /// \param type  UnstructuredGrid or PolyData
  /// \throw InputError  the file has another type or format, is damaged, or has several pieces
  explicit VtkArrays(const FileBytes& file, const char* type = "UnstructuredGrid");

  /// \param parent  Points, Cells, Polys, CellData and so on
  /// \param name    empty: any
  /// \return        an empty one if there is none
  Array find(const char* parent, std::string_view name) const;
  /// \throw InputError  there is none
  Array required(const char* parent, std::string_view name) const;

  /// All arrays of the file and of its piece in this parent.
  std::vector<Array> all(const char* parent) const;

  /// A count that the Piece claims.
  std::size_t claimed(const char* name) const;
  void check_size(Array array, std::size_t found, std::size_t due) const;

  /// The numbers of an array. Value is double or std::int64_t.
  template <class Value>
  StoredNumbers<Value> read(Array array) const;

  /// The place of an array in the file.
  std::size_t begin_of(Array array) const;
  [[noreturn]] void fail(std::size_t byte, const std::string& what, const std::string& remedy = damaged_remedy) const;

  static constexpr const char* damaged_remedy = "export the file again";

 private:
  void load_outline();
  std::string_view text_of(Array array) const;
  std::size_t appended_begin(Array array) const;
  std::string_view encoded_bytes(Array array) const;
  RawVector<char> bytes_of(Array array) const;
  std::uint64_t length_at(std::string_view bytes, std::size_t index, Array array) const;
  RawVector<char> without_length(Array array, std::string_view bytes) const;
  RawVector<char> decompressed(Array array, std::string_view bytes) const;

  const FileBytes& file_;
  pugi::xml_document document_;
  pugi::xml_node header_, piece_, appended_;
  std::size_t appended_begin_ = 0, appended_end_ = 0;
  bool big_endian_ = false;
  std::size_t length_size_ = 4;  ///< of the numbers before an array, in bytes
};

extern template StoredNumbers<double> VtkArrays::read<double>(Array array) const;
extern template StoredNumbers<std::int64_t> VtkArrays::read<std::int64_t>(Array array) const;

}  // namespace ccdt::io
