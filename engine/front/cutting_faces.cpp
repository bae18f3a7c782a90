#include "engine/front/cutting_faces.h"

#include <algorithm>

#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/geometry/predicates.h"

namespace ccdt::front {
namespace {

constexpr std::uint32_t no_side = 0xFFFFFFFFu;

/// The faces at edges between some vertices. Side i of the facets is the edge of triangle i / 3 from its corner i % 3
/// on.
class FacesAtEdges {
 public:
  FacesAtEdges(const facets::FacetMesh& facets, std::span<const std::uint8_t> is_used)
      : next_(3 * facets.triangles.size(), no_side) {
    for (std::uint32_t side = 0; side < next_.size(); ++side) {
      const auto& t = facets.triangles[side / 3];
      const std::uint32_t p = t[side % 3], q = t[(side + 1) % 3];
      if ((is_used[p] & is_used[q]) == 0) continue;
      const auto [first, is_new] = first_.insert(edge_key(p, q), side);
      if (is_new) continue;
      next_[side] = next_[*first];
      next_[*first] = side;
    }
  }

  template <class Visit>
  void for_each(std::uint32_t p, std::uint32_t q, const Visit& visit) const {
    const std::uint32_t* const first = first_.find(edge_key(p, q));
    for (std::uint32_t side = first == nullptr ? no_side : *first; side != no_side; side = next_[side]) visit(side);
  }

 private:
  HashTable<std::uint64_t, std::uint32_t> first_;
  std::vector<std::uint32_t> next_;
};

}  // namespace

std::vector<std::uint32_t> find_cutting_faces(const facets::FacetMesh& facets, const delaunay::Delaunay& delaunay,
                                              std::span<const std::array<std::uint32_t, 4>> tetrahedra) {
  std::vector<std::uint32_t> cutting;
  if (tetrahedra.empty()) return cutting;
  std::vector<std::uint8_t> is_used(delaunay.vertices.size(), 0);
  for (const auto& t : tetrahedra)
    for (const std::uint32_t v : t) is_used[v] = 1;
  const FacesAtEdges faces(facets, is_used);
  const auto orient = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    return numbers::orient3d(delaunay.point(a), delaunay.point(b), delaunay.point(c), delaunay.point(d));
  };
  for (const auto& t : tetrahedra)
    for (const auto& [i, j, k, l] : delaunay::edge_corners) {
      const std::uint32_t p = t[i], q = t[j], c = t[k], d = t[l];
      faces.for_each(p, q, [&](std::uint32_t side) {
        const std::uint32_t apex = facets.triangles[side / 3][(side + 2) % 3];
        if (apex != c && apex != d && orient(p, q, c, apex) > 0 && orient(p, q, apex, d) > 0)
          faces.for_each(p, q, [&](std::uint32_t other) { cutting.push_back(other / 3); });
      });
    }
  std::ranges::sort(cutting);
  const auto repeated = std::ranges::unique(cutting);
  cutting.erase(repeated.begin(), repeated.end());
  return cutting;
}

}  // namespace ccdt::front
