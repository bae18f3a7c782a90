#include "engine/plc/boundary_sides.h"

#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"

namespace ccdt::plc {

std::vector<std::uint32_t> count_boundary_sides(const Plc& plc) {
  HashTable<std::uint64_t, std::uint32_t> segment_of_edge;
  segment_of_edge.reserve(plc.segments.size());
  for (std::uint32_t s = 0; s < plc.segments.size(); ++s)
    segment_of_edge.set(edge_key(plc.segments[s].ends[0], plc.segments[s].ends[1]), s);
  std::vector<std::uint32_t> sides(plc.segments.size(), 0);
  for (const Facet& facet : plc.facets) {
    if (plc.regions[facet.above].inside == plc.regions[facet.below].inside) continue;
    for (const auto& [a, b, c] : plc.triangles_of(facet))
      for (const std::uint64_t edge : {edge_key(a, b), edge_key(b, c), edge_key(c, a)})
        if (const std::uint32_t* const segment = segment_of_edge.find(edge)) ++sides[*segment];
  }
  return sides;
}

}  // namespace ccdt::plc
