#include "engine/folds/find_contacts.h"

#include <algorithm>
#include <array>

#include "engine/base/box_tree.h"
#include "engine/front/find_delaunay_faces.h"
#include "engine/numbers/predicates.h"
#include "engine/plc/find_overlaps.h"

namespace ccdt::folds {
namespace {

using Triangle = std::array<VertexId, 3>;

/// Puts the common vertices of two triangles first, in both.
///
/// \return their number
std::size_t pair_corners(Triangle& s, Triangle& t) {
  std::size_t common = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto same = std::find(t.begin() + static_cast<std::ptrdiff_t>(common), t.end(), s[i]);
    if (same == t.end()) continue;
    std::swap(s[i], s[common]);
    std::swap(*same, t[common++]);
  }
  return common;
}

/// Do two triangles meet in more than common vertices and edges?
bool meet(Triangle s, Triangle t, const delaunay::Delaunay& d) {
  const std::size_t common = pair_corners(s, t);
  const auto points_of = [&](const Triangle& c) { return std::array{d.point(c[0]), d.point(c[1]), d.point(c[2])}; };
  const auto p = points_of(s), q = points_of(t);
  if (common == 0) return plc::meet_triangles(p, q).has_value();
  if (common == 1) return plc::meet_triangles_at_corner(p, q).has_value();
  if (common == 3) return true;
  return numbers::orient3d(p[0], p[1], p[2], q[2]) == 0 && dot(area_vector(p), area_vector(q)) > 0;
}

}  // namespace

std::vector<std::uint32_t> find_contacts(const facets::FacetMesh& facets, const delaunay::Delaunay& d,
                                         const std::vector<FacetOrigin>& origins) {
  const auto box_of_face = [&](std::uint32_t face) {
    const auto& [a, b, c] = facets.triangles[face];
    return bounding_box(std::array{d.point(a), d.point(b), d.point(c)});
  };
  const std::vector<std::uint32_t> codes = front::find_delaunay_faces(facets.triangles, d);
  std::vector<std::uint32_t> missing;
  RawVector<Box> boxes;
  for (std::uint32_t i = 0; i < codes.size(); ++i) {
    if (codes[i] != delaunay::no_neighbor) continue;
    missing.push_back(i);
    boxes.push_back(box_of_face(i));
  }
  const BoxTree tree(std::move(boxes));
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < facets.triangles.size(); ++i) {
    const FacetOrigin& one = origins[facets.facet[i]];
    tree.for_each_meeting(box_of_face(i), [&](std::uint32_t m) {
      const std::uint32_t j = missing[m];
      const FacetOrigin& other = origins[facets.facet[j]];
      if ((!one.moved && !other.moved) || one.facet == other.facet) return;
      if (!meet(facets.triangles[i], facets.triangles[j], d)) return;
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
