#include "engine/facets/touching_faces.h"

#include <algorithm>

#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"

namespace ccdt::facets {
namespace {

/// Hashes a facet and one of its segments.
std::uint64_t part_key(std::uint32_t facet, std::uint32_t segment) {
  return std::uint64_t{facet} << 32 | segment;
}

/// The segments of the facets that are flat only within the tolerance.
HashSet<std::uint64_t> segments_of_bent_facets(const plc::Plc& plc) {
  std::vector<std::array<VertexId, 2>> ends;
  ends.reserve(plc.segments.size());
  for (const plc::Segment& s : plc.segments) ends.push_back(s.ends);
  const EdgeMap segment_of_edge(ends, plc.vertices.size());
  HashSet<std::uint64_t> parts;
  for (std::uint32_t f = 0; f < plc.facets.size(); ++f) {
    if (plc.facets[f].exactly_flat) continue;
    for (const auto& t : plc.facets[f].triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (const std::uint32_t s = segment_of_edge.find(t[k], t[(k + 1) % 3]); s != EdgeMap::none)
          parts.insert(part_key(f, s), {});
  }
  return parts;
}

/// The segments, by the edges along them.
HashTable<std::uint64_t, std::uint32_t> list_edges(const protection::SegmentChains& chains) {
  HashTable<std::uint64_t, std::uint32_t> segments;
  for (std::uint32_t s = 0; s < chains.size(); ++s)
    for (std::size_t i = 0; i + 1 < chains[s].size(); ++i)
      segments.set(edge_key(chains[s][i].vertex, chains[s][i + 1].vertex), s);
  return segments;
}

}  // namespace

std::vector<std::uint32_t> find_touching_faces(const plc::Plc& plc, const protection::SegmentChains& chains,
                                               const FacetMesh& facets) {
  std::vector<std::uint32_t> touching;
  if (std::ranges::all_of(plc.facets, &plc::Facet::exactly_flat)) return touching;
  const HashSet<std::uint64_t> parts = segments_of_bent_facets(plc);
  const HashTable<std::uint64_t, std::uint32_t> segments = list_edges(chains);
  HashTable<FaceKey, std::uint32_t> faces;
  for (std::uint32_t i = 0; i < facets.triangles.size(); ++i) {
    const FacetId facet = facets.facet[i];
    const auto& t = facets.triangles[i];
    const auto [first, is_new] = faces.insert(face_key(t[0], t[1], t[2]), i);
    if (!is_new) touching.insert(touching.end(), {*first, i});
    if (plc.facets[facet].exactly_flat) continue;
    const bool touches = std::ranges::any_of(std::array{0, 1, 2}, [&](int k) {
      const std::uint32_t* const s = segments.find(edge_key(t[k], t[(k + 1) % 3]));
      return s != nullptr && !parts.contains(part_key(facet, *s));
    });
    if (touches) touching.push_back(i);
  }
  std::ranges::sort(touching);
  const auto repeated = std::ranges::unique(touching);
  touching.erase(repeated.begin(), repeated.end());
  return touching;
}

}  // namespace ccdt::facets
