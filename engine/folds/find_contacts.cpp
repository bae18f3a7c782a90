#include "engine/folds/find_contacts.h"

#include <algorithm>
#include <array>

#include "engine/base/parallel.h"
#include "engine/geometry/box_tree.h"
#include "engine/geometry/contacts.h"

namespace ccdt::folds {

std::vector<std::uint32_t> find_contacts(const facets::FacetMesh& facets, const delaunay::Delaunay& d,
                                         std::span<const std::uint32_t> codes,
                                         const std::vector<FacetOrigin>& origins) {
  const auto point = [&](VertexId v) { return d.point(v); };
  const auto box_of_face = [&](std::uint32_t face) {
    const auto& [a, b, c] = facets.triangles[face];
    return bounding_box(std::array{point(a), point(b), point(c)});
  };
  const std::vector<std::uint32_t> missing =
      parallel_select(codes.size(), 4096, [&](std::size_t i) { return codes[i] == delaunay::no_neighbor; });
  if (missing.empty()) return {};
  const BoxTree tree(missing, box_of_face);
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < facets.triangles.size(); ++i) {
    const FacetOrigin& one = origins[facets.facet[i]];
    tree.for_each_meeting(box_of_face(i), [&](std::uint32_t m) {
      const std::uint32_t j = missing[m];
      const FacetOrigin& other = origins[facets.facet[j]];
      if ((!one.moved && !other.moved) || one.facet == other.facet) return;
      if (!cross_or_fold(facets.triangles[i], facets.triangles[j], point)) return;
      if (one.moved) found.push_back(i);
      if (other.moved) found.push_back(j);
    });
  }
  std::ranges::sort(found);
  const auto repeated = std::ranges::unique(found);
  found.erase(repeated.begin(), repeated.end());
  return found;
}

}  // namespace ccdt::folds
