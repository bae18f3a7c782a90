#include "engine/front/face_check.h"

#include <algorithm>

#include "engine/base/simplex_map.h"

namespace ccdt::front {
namespace {

using Triangle = std::array<VertexId, 3>;

/// Is the face f of the cell seen counterclockwise from within the cell?
bool is_above(const delaunay::Cell& cell, std::uint32_t f, const Triangle& t) {
  const auto& corner = delaunay::face_corners[f];
  const std::uint32_t a = cell.vertices[corner[0]], b = cell.vertices[corner[1]], c = cell.vertices[corner[2]];
  return (a == t[0] && b == t[1]) || (b == t[0] && c == t[1]) || (c == t[0] && a == t[1]);
}

}  // namespace

std::vector<std::uint32_t> find_delaunay_faces(const facets::FacetMesh& facets, const delaunay::Delaunay& delaunay) {
  std::vector<std::uint32_t> codes(facets.triangles.size(), delaunay::no_neighbor);
  std::uint32_t vertices = 0;  // ids from here on are of vertices that no face has
  for (const Triangle& t : facets.triangles) vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
  const FaceMap faces(facets.triangles, vertices);
  // One pass over the cells, most of which are inside and passed over at once. (The ghosts' faces are theirs too.)
  for (std::uint32_t c = 0; c < delaunay.cells.size(); ++c) {
    const delaunay::Cell& cell = delaunay.cells[c];
    const auto& v = cell.vertices;
    const unsigned inner = (v[0] >= vertices) + (v[1] >= vertices) + (v[2] >= vertices) + (v[3] >= vertices);
    if (inner > 1 || delaunay.is_dead(c)) continue;
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (inner == 1 && v[f] < vertices) continue;
      if (delaunay::face_code(c, f) > cell.neighbors[f]) continue;  // once a face
      const auto& corner = delaunay::face_corners[f];
      const std::uint32_t face = faces.find(v[corner[0]], v[corner[1]], v[corner[2]]);
      if (face == FaceMap::none) continue;
      codes[face] = is_above(cell, f, facets.triangles[face]) ? delaunay::face_code(c, f) : cell.neighbors[f];
    }
  }
  return codes;
}

}  // namespace ccdt::front
