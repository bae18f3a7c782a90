#include "engine/front/face_check.h"

#include <algorithm>

namespace ccdt {
namespace {

using Triangle = std::array<VertexId, 3>;

/// The faces of the PLC by their least vertex: those of vertex v are entries[first[v]] to entries[first[v + 1]].
class FaceTable {
 public:
  explicit FaceTable(const std::vector<Triangle>& triangles);

  /// Ids from here on are of vertices that no face has.
  std::uint32_t vertices() const { return static_cast<std::uint32_t>(first_.size() - 1); }

  /// The face that has these three vertices, in any order; `no_neighbor` if there is none.
  std::uint32_t find(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    if (a > b) std::swap(a, b);
    if (b > c) std::swap(b, c);
    if (a > b) std::swap(a, b);
    for (std::uint32_t i = first_[a]; i < first_[a + 1]; ++i)
      if (entries_[i].middle == b && entries_[i].greatest == c) return entries_[i].face;
    return no_neighbor;
  }

 private:
  struct Entry {
    std::uint32_t middle, greatest, face;
  };
  std::vector<std::uint32_t> first_;
  std::vector<Entry> entries_;
};

FaceTable::FaceTable(const std::vector<Triangle>& triangles) : entries_(triangles.size()) {
  std::uint32_t vertices = 0;
  for (const Triangle& t : triangles) vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
  first_.assign(vertices + 1, 0);
  for (const Triangle& t : triangles) ++first_[std::min({t[0], t[1], t[2]})];
  // From counts to ends; filling from behind turns the ends into beginnings.
  for (std::uint32_t v = 1; v <= vertices; ++v) first_[v] += first_[v - 1];
  for (std::uint32_t f = 0; f < triangles.size(); ++f) {
    std::array<std::uint32_t, 3> v = {triangles[f][0], triangles[f][1], triangles[f][2]};
    std::ranges::sort(v);
    entries_[--first_[v[0]]] = {v[1], v[2], f};
  }
}

/// Is the face f of the cell seen counterclockwise from within the cell?
bool is_above(const Cell& cell, std::uint32_t f, const Triangle& t) {
  const auto& corner = face_corners[f];
  const std::uint32_t a = cell.vertices[corner[0]], b = cell.vertices[corner[1]], c = cell.vertices[corner[2]];
  return (a == t[0] && b == t[1]) || (b == t[0] && c == t[1]) || (c == t[0] && a == t[1]);
}

}  // namespace

std::vector<std::uint32_t> find_delaunay_faces(const FacetMesh& facets, const Delaunay& delaunay) {
  std::vector<std::uint32_t> codes(facets.triangles.size(), no_neighbor);
  const FaceTable table(facets.triangles);
  const std::uint32_t vertices = table.vertices();
  // One pass over the cells, most of which are inside and passed over at once. (The ghosts' faces are theirs too.)
  for (std::uint32_t c = 0; c < delaunay.cells.size(); ++c) {
    const Cell& cell = delaunay.cells[c];
    const auto& v = cell.vertices;
    const unsigned inner = (v[0] >= vertices) + (v[1] >= vertices) + (v[2] >= vertices) + (v[3] >= vertices);
    if (inner > 1 || delaunay.is_dead(c)) continue;
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (inner == 1 && v[f] < vertices) continue;
      if (face_code(c, f) > cell.neighbors[f]) continue;  // once a face
      const auto& corner = face_corners[f];
      const std::uint32_t face = table.find(v[corner[0]], v[corner[1]], v[corner[2]]);
      if (face == no_neighbor) continue;
      codes[face] = is_above(cell, f, facets.triangles[face]) ? face_code(c, f) : cell.neighbors[f];
    }
  }
  return codes;
}

}  // namespace ccdt
