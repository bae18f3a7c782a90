#include "engine/front/count_segments.h"

#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"

namespace ccdt::front {
namespace {

HashSet<std::uint64_t> edges_of_undelaunay_faces(const facets::FacetMesh& facets,
                                                 const std::vector<std::uint32_t>& codes) {
  HashSet<std::uint64_t> edges;
  for (std::size_t f = 0; f < codes.size(); ++f) {
    if (codes[f] != delaunay::no_neighbor) continue;
    const auto& t = facets.triangles[f];
    for (int i = 0; i < 3; ++i) edges.insert(edge_key(t[i], t[i < 2 ? i + 1 : 0]));
  }
  return edges;
}

}  // namespace

SegmentCounts count_segments(const plc::Plc& plc, const protection::SegmentChains& chains,
                             const facets::FacetMesh& facets, const std::vector<std::uint32_t>& codes,
                             const delaunay::Delaunay& delaunay) {
  const HashSet<std::uint64_t> uncertain = edges_of_undelaunay_faces(facets, codes);
  const auto is_delaunay = [&](VertexId a, VertexId b) {
    return !uncertain.contains(edge_key(a, b)) || has_edge(delaunay, a, b);
  };
  SegmentCounts counts;
  counts.all = plc.segments.size();
  for (std::size_t s = 0; s < plc.segments.size(); ++s) {
    const auto chain = chains[s];
    counts.grazeable += plc.segments[s].grazeable;
    if (protection::is_split(chain)) {
      ++counts.split;
      counts.pieces += chain.size() - 1;
      continue;
    }
    bool all_delaunay = true;
    for (std::size_t i = 0; all_delaunay && i + 1 < chain.size(); ++i)
      all_delaunay = is_delaunay(chain[i].vertex, chain[i + 1].vertex);
    ++(all_delaunay ? counts.delaunay : counts.front);
  }
  return counts;
}

}  // namespace ccdt::front
