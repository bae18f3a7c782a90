#include "engine/front/find_facet_faces.h"

#include "engine/base/parallel.h"
#include "engine/front/find_delaunay_faces.h"

namespace ccdt::front {

std::vector<std::uint32_t> find_facet_faces(const plc::Plc& plc, const facets::FacetMesh& facets,
                                            const delaunay::Delaunay& delaunay) {
  std::vector<std::uint32_t> earlier(facets.facet.size(), plc::no_face);
  parallel_ranges(earlier.size(), 4096, [&](std::size_t i, std::size_t end) {
    std::size_t first = i;  // of the facet
    while (first > 0 && facets.facet[first - 1] == facets.facet[i]) --first;
    for (; i < end; ++i) {
      if (facets.facet[i] != facets.facet[first]) first = i;
      // If the facet got other triangles, this may be the face of another triangle.
      const plc::Facet& facet = plc.facets[facets.facet[i]];
      if (i - first < facet.triangle_count) earlier[i] = plc.faces[facet.first_triangle + (i - first)];
    }
  });
  return find_delaunay_faces_again(facets.triangles, earlier, delaunay);
}

}  // namespace ccdt::front
