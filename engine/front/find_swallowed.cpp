#include "engine/front/find_swallowed.h"

#include <algorithm>
#include <array>

#include "engine/base/box.h"
#include "engine/base/parallel.h"
#include "engine/geometry/box_tree.h"
#include "engine/geometry/predicates.h"

namespace ccdt::front {
namespace {

using Tetrahedron = std::array<std::uint32_t, 4>;

std::vector<bool> corners_of(std::span<const Tetrahedron> tetrahedra, const facets::FacetMesh& facets,
                             std::size_t vertices) {
  std::vector<bool> is_corner(vertices, false);
  for (const auto& triangle : facets.triangles)
    for (const std::uint32_t v : triangle) is_corner[v] = true;
  for (const Tetrahedron& t : tetrahedra)
    for (const std::uint32_t v : t)
      if (v != delaunay::ghost_vertex) is_corner[v] = true;
  return is_corner;
}

bool holds(const delaunay::Delaunay& d, const Tetrahedron& t, const Point3& p) {
  for (std::uint32_t f = 0; f < 4; ++f) {
    const auto [a, b, c] = delaunay::corners_of_face(t, f);
    if (orient3d(d.point(a), d.point(b), d.point(c), p) < 0) return false;
  }
  return true;
}

}  // namespace

std::vector<std::uint32_t> find_swallowing(std::span<const Tetrahedron> tetrahedra, const facets::FacetMesh& facets,
                                           const delaunay::Delaunay& d) {
  std::vector<std::uint32_t> found;
  const std::vector<bool> is_corner = corners_of(tetrahedra, facets, d.vertices.size());
  if (std::ranges::find(is_corner, false) == is_corner.end()) return found;
  const std::vector<std::uint32_t> real = parallel_select(
      tetrahedra.size(), 4096, [&](std::size_t i) { return tetrahedra[i][3] != delaunay::ghost_vertex; });
  const BoxTree tree(real, [&](std::uint32_t i) {
    const auto& [a, b, c, apex] = tetrahedra[i];
    return bounding_box(std::array{d.point(a), d.point(b), d.point(c), d.point(apex)});
  });
  for (std::uint32_t v = 0; v < is_corner.size(); ++v) {
    if (is_corner[v]) continue;
    tree.for_each_meeting(box_of(d.point(v)), [&](std::uint32_t i) {
      if (holds(d, tetrahedra[real[i]], d.point(v))) found.push_back(real[i]);
    });
  }
  std::ranges::sort(found);
  found.erase(std::ranges::unique(found).begin(), found.end());
  return found;
}

}  // namespace ccdt::front
