#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/delaunay/delaunay.h"

namespace ccdt::delaunay {

/// Walks the cells around vertices; owns the marks that this takes, so it is made once and used often.
class CellStar {
 public:
  explicit CellStar(const Delaunay& delaunay) : d_(delaunay) {}

  /// All cells, finite and ghost, that have the vertex; valid until the next call.
  std::span<const std::uint32_t> around(std::uint32_t vertex);

  /// Is ab an edge of the tetrahedralization?
  bool has_edge(std::uint32_t a, std::uint32_t b);

  /// The face abc as the cell above it (from where abc is counterclockwise) calls it; `no_neighbor` if it is no face.
  std::uint32_t find_face(std::uint32_t a, std::uint32_t b, std::uint32_t c);

 private:
  const Delaunay& d_;
  std::vector<std::uint32_t> seen_;  // the number of the last search that reached the cell
  std::uint32_t search_ = 0;
  std::vector<std::uint32_t> cells_;
};

}  // namespace ccdt::delaunay
