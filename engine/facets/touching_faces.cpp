#include "engine/facets/touching_faces.h"

#include <algorithm>

#include "engine/base/hash_table.h"
#include "engine/base/parallel.h"
#include "engine/base/simplex_map.h"

namespace ccdt::facets {
namespace {

/// Hashes a facet and one of its segments.
std::uint64_t part_key(std::uint32_t facet, std::uint32_t segment) {
  return std::uint64_t{facet} << 32 | segment;
}

/// The vertices of the facets that are flat only within the tolerance, the bent ones. Only where all vertices are
/// theirs can something touch.
class BentVertices {
 public:
  BentVertices(const plc::Plc& plc, const FacetMesh& facets, std::size_t vertices) : is_bent_(vertices) {
    for (std::uint32_t i = 0; i < facets.triangles.size(); ++i)
      if (!plc.facets[facets.facet[i]].exactly_flat)
        for (const VertexId v : facets.triangles[i]) is_bent_[v] = 1;
  }

  template <class... Vertices>
  bool have(Vertices... vertices) const {
    return (is_bent_[vertices] & ...) != 0;
  }

 private:
  std::vector<std::uint8_t> is_bent_;
};

/// The segments, by the edges along them.
HashTable<std::uint64_t, std::uint32_t> list_edges(const plc::Plc& plc, const protection::SegmentChains& chains,
                                                   const BentVertices& bent) {
  HashTable<std::uint64_t, std::uint32_t> segments;
  for (std::uint32_t s = 0; s < chains.size(); ++s) {
    if (const auto [a, b] = plc.segments[s].ends; !bent.have(a, b)) continue;
    for (std::size_t i = 0; i + 1 < chains[s].size(); ++i)
      if (const VertexId a = chains[s][i].vertex, b = chains[s][i + 1].vertex; bent.have(a, b))
        segments.set(edge_key(a, b), s);
  }
  return segments;
}

/// The segments of the bent facets.
HashSet<std::uint64_t> segments_of_bent_facets(const plc::Plc& plc, const BentVertices& bent) {
  HashTable<std::uint64_t, std::uint32_t> segments;
  for (std::uint32_t s = 0; s < plc.segments.size(); ++s)
    if (const auto [a, b] = plc.segments[s].ends; bent.have(a, b)) segments.set(edge_key(a, b), s);
  HashSet<std::uint64_t> parts;
  for (std::uint32_t f = 0; f < plc.facets.size(); ++f) {
    if (plc.facets[f].exactly_flat) continue;
    for (const auto& t : plc.triangles_of(plc.facets[f]))
      for (std::size_t k = 0; k < 3; ++k)
        if (const std::uint32_t* const s = segments.find(edge_key(t[k], t[(k + 1) % 3])); s != nullptr)
          parts.insert(part_key(f, *s), {});
  }
  return parts;
}

}  // namespace

std::vector<std::uint32_t> find_touching_faces(const plc::Plc& plc, const protection::SegmentChains& chains,
                                               const FacetMesh& facets, std::size_t vertices) {
  std::vector<std::uint32_t> touching;
  if (std::ranges::all_of(plc.facets, &plc::Facet::exactly_flat)) return touching;
  const BentVertices bent(plc, facets, vertices);
  HashSet<std::uint64_t> parts;
  HashTable<std::uint64_t, std::uint32_t> segments;
  parallel_both([&] { parts = segments_of_bent_facets(plc, bent); }, [&] { segments = list_edges(plc, chains, bent); });
  HashTable<FaceKey, std::uint32_t> faces;
  for (std::uint32_t i = 0; i < facets.triangles.size(); ++i) {
    const FacetId facet = facets.facet[i];
    const auto& t = facets.triangles[i];
    if (!bent.have(t[0], t[1], t[2])) continue;
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
