#include "engine/mesh/peel_flat_tetrahedra.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_set>

#include "engine/base/simplex_map.h"
#include "engine/delaunay/delaunay.h"

namespace ccdt {
namespace {

using Triangle = std::array<VertexId, 3>;
using Corners = std::array<std::uint32_t, 3>;

Corners sorted(Corners c) {
  std::sort(c.begin(), c.end());
  return c;
}

bool is_bent_boundary(const Plc& plc, const Facet& facet) {
  return !facet.exactly_flat && plc.regions[facet.above].inside != plc.regions[facet.below].inside;
}

/// The boundary facets that are not exactly flat, and the tetrahedra within them.
class Peeler {
 public:
  Peeler(const Plc& plc, const SegmentChains& chains, FacetMesh& facets, TetMesh& mesh);

  void peel();

 private:
  bool lies_within_facet(const std::array<std::uint32_t, 4>& t) const;
  bool try_to_peel(const std::array<std::uint32_t, 4>& t);

  const Plc& plc_;
  FacetMesh& facets_;
  TetMesh& mesh_;
  std::map<Corners, std::size_t> triangle_of_;            // of those facets, by sorted corners
  std::map<std::uint32_t, std::set<FacetId>> facets_of_;  // by vertex
  std::unordered_set<std::uint64_t> segment_edges_;
};

Peeler::Peeler(const Plc& plc, const SegmentChains& chains, FacetMesh& facets, TetMesh& mesh)
    : plc_(plc), facets_(facets), mesh_(mesh) {
  for (std::size_t i = 0; i < facets.triangles.size(); ++i) {
    if (!is_bent_boundary(plc, plc.facets[facets.facet[i]])) continue;
    const Triangle& t = facets.triangles[i];
    triangle_of_[sorted({t[0], t[1], t[2]})] = i;
    for (const VertexId v : t) facets_of_[v].insert(facets.facet[i]);
  }
  if (triangle_of_.empty()) return;
  for (const auto& chain : chains)
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      segment_edges_.insert(edge_key(chain[i].vertex, chain[i + 1].vertex));
}

bool Peeler::lies_within_facet(const std::array<std::uint32_t, 4>& t) const {
  const auto first = facets_of_.find(t[0]);
  if (first == facets_of_.end()) return false;
  return std::any_of(first->second.begin(), first->second.end(), [&](FacetId f) {
    return std::all_of(t.begin() + 1, t.end(), [&](std::uint32_t v) {
      const auto its = facets_of_.find(v);
      return its != facets_of_.end() && its->second.contains(f);
    });
  });
}

bool Peeler::try_to_peel(const std::array<std::uint32_t, 4>& t) {
  std::array<std::uint32_t, 2> outer{}, inner{};  // faces, by the corner opposite to them
  std::array<std::size_t, 2> triangles{};
  int outers = 0, inners = 0;
  for (std::uint32_t f = 0; f < 4; ++f) {
    const auto& c = face_corners[f];
    const auto found = triangle_of_.find(sorted({t[c[0]], t[c[1]], t[c[2]]}));
    if (found != triangle_of_.end() && outers < 2) {
      triangles[outers] = found->second;
      outer[outers++] = f;
    } else if (found == triangle_of_.end() && inners < 2) {
      inner[inners++] = f;
    }
  }
  if (outers != 2 || inners != 2 || facets_.facet[triangles[0]] != facets_.facet[triangles[1]]) return false;
  // The outer faces meet in the edge between the corners that the inner faces are opposite to.
  if (segment_edges_.contains(edge_key(t[inner[0]], t[inner[1]]))) return false;
  const Facet& facet = plc_.facets[facets_.facet[triangles[0]]];
  for (int i = 0; i < 2; ++i) {
    const Triangle& old = facets_.triangles[triangles[i]];
    triangle_of_.erase(sorted({old[0], old[1], old[2]}));
  }
  for (int i = 0; i < 2; ++i) {
    // Face corners see the tetrahedron above them; the facet's triangles have the domain above or below.
    const auto& c = face_corners[inner[i]];
    Corners corners{t[c[0]], t[c[1]], t[c[2]]};
    if (plc_.regions[facet.above].inside) std::swap(corners[0], corners[1]);
    facets_.triangles[triangles[i]] = {VertexId(corners[0]), VertexId(corners[1]), VertexId(corners[2])};
    triangle_of_[sorted(corners)] = triangles[i];
  }
  return true;
}

void Peeler::peel() {
  if (triangle_of_.empty()) return;
  std::vector<std::size_t> flat;
  for (std::size_t i = 0; i < mesh_.tetrahedra.size(); ++i)
    if (lies_within_facet(mesh_.tetrahedra[i])) flat.push_back(i);
  // In an order that does not depend on how the tetrahedra were found.
  const auto corners = [&](std::size_t i) {
    std::array<std::uint32_t, 4> t = mesh_.tetrahedra[i];
    std::sort(t.begin(), t.end());
    return t;
  };
  std::sort(flat.begin(), flat.end(), [&](std::size_t i, std::size_t j) { return corners(i) < corners(j); });
  std::vector<bool> gone(mesh_.tetrahedra.size(), false);
  for (bool changed = true; changed;) {
    changed = false;
    for (const std::size_t i : flat) {
      if (gone[i] || !try_to_peel(mesh_.tetrahedra[i])) continue;
      gone[i] = changed = true;
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < gone.size(); ++i) {
    if (gone[i]) continue;
    mesh_.tetrahedra[kept] = mesh_.tetrahedra[i];
    mesh_.regions[kept++] = mesh_.regions[i];
  }
  mesh_.tetrahedra.resize(kept);
  mesh_.regions.resize(kept);
}

}  // namespace

void peel_flat_tetrahedra(const Plc& plc, const SegmentChains& chains, FacetMesh& facets, TetMesh& mesh) {
  Peeler(plc, chains, facets, mesh).peel();
}

}  // namespace ccdt
