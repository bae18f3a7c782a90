#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/plc/triangle_set.h"

namespace ccdt {

/// The edges of a set of triangles, sorted by their ends, each with the triangles around it. It does not depend on how
/// the triangles are oriented.
struct EdgeTable {
  std::vector<std::array<VertexId, 2>> ends;  ///< of each edge, the smaller first
  std::vector<std::uint32_t> first;           ///< triangles of edge e: triangles[first[e]] ... triangles[first[e+1]-1]
  std::vector<std::uint32_t> triangles;       ///< increasing within an edge, until `sort_around_edges`
  std::vector<std::array<std::uint32_t, 3>> edges_of;  ///< the three edges of each triangle, in no particular order

  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  std::uint32_t size() const { return static_cast<std::uint32_t>(ends.size()); }
  std::span<const std::uint32_t> around(std::uint32_t edge) const {
    return {triangles.data() + first[edge], first[edge + 1] - first[edge]};
  }
  std::span<std::uint32_t> around(std::uint32_t edge) {
    return {triangles.data() + first[edge], first[edge + 1] - first[edge]};
  }
  /// The edge between two vertices, or `none`.
  std::uint32_t find(VertexId a, VertexId b) const;
};

EdgeTable make_edge_table(std::span<const Corners> triangles);

}  // namespace ccdt
