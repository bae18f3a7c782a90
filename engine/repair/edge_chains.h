#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/hash_table.h"
#include "engine/base/index.h"
#include "engine/base/point.h"
#include "engine/base/simplex_map.h"

namespace ccdt::repair {

/// The vertices that divide edges. They are the same, in the same order, for all triangles at an edge.
class EdgeChains {
 public:
  /// \param on_edges  vertices on edges or within rounding of them, in any order; those at an end do not count
  EdgeChains(std::span<const Point3> vertices, std::vector<AtEdge> on_edges);

  bool has(VertexId a, VertexId b) const { return places_.contains(edge_key(a, b)); }
  /// The vertices between a and b, in order.
  std::vector<VertexId> between(VertexId a, VertexId b) const;

 private:
  HashTable<std::uint64_t, std::array<std::uint32_t, 2>> places_;  // of an edge: begin and end in `vertices_`
  std::vector<VertexId> vertices_;                                 // of each edge from its smaller end to its greater
};

}  // namespace ccdt::repair
