#include "engine/front/face_check.h"

#include "engine/delaunay/cell_star.h"

namespace ccdt {

std::vector<std::uint32_t> find_delaunay_faces(const FacetMesh& facets, const Delaunay& delaunay) {
  CellStar star(delaunay);
  std::vector<std::uint32_t> codes(facets.triangles.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const auto& t = facets.triangles[i];
    codes[i] = star.find_face(t[0], t[1], t[2]);
  }
  return codes;
}

}  // namespace ccdt
