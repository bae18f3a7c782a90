#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/delaunay/delaunay.h"

namespace ccdt {

/// The faces that have a cell on one side only, by their corners: the front of a construction face by face. A hash
/// table with open addressing, whose entries are a hash and a face code; the corners are looked up in the cells.
class OpenFaces {
 public:
  /// Closes the face with the open one that has the same corners, and makes them neighbors; if there is none, the face
  /// stays open. \return was it closed?
  bool close_or_open(std::vector<Cell>& cells, std::uint32_t code);

 private:
  // A hash above a face code; empty: all bits, which no entry has, as no face is no_neighbor.
  static constexpr std::uint64_t empty = ~std::uint64_t{0};
  static std::uint32_t hash_of(std::uint64_t entry) { return static_cast<std::uint32_t>(entry >> 32); }
  static std::uint32_t code_in(std::uint64_t entry) { return static_cast<std::uint32_t>(entry); }

  void erase(std::size_t place);
  void grow();

  std::vector<std::uint64_t> table_ = std::vector<std::uint64_t>(1024, empty);
  std::size_t mask_ = 1023, size_ = 0;
};

/// The corners of a face, such that the vertex opposite to it is below them.
std::array<std::uint32_t, 3> outward_corners(const std::vector<Cell>& cells, std::uint32_t code);

}  // namespace ccdt
