#include "engine/improve/sort_cells.h"

#include <algorithm>

namespace ccdt {
namespace {

using Tetrahedron = std::array<std::uint32_t, 4>;

struct LabelledCell {
  Tetrahedron vertices;
  int region;
};

/// The even permutation with the least vertex first and the least of the others second.
Tetrahedron in_order(Tetrahedron t) {
  const auto least = std::min_element(t.begin(), t.end()) - t.begin();
  if (least != 0) {
    // Two exchanges keep the orientation.
    std::swap(t[0], t[static_cast<std::size_t>(least)]);
    std::swap(least == 1 ? t[2] : t[1], t[3 == least ? 2 : 3]);
  }
  std::rotate(t.begin() + 1, std::min_element(t.begin() + 1, t.end()), t.end());
  return t;
}

}  // namespace

void sort_cells(TetMesh& mesh) {
  // A counting sort by the first vertex leaves a few cells a bucket.
  std::vector<std::uint32_t> begin;
  for (Tetrahedron& t : mesh.tetrahedra) {
    t = in_order(t);
    if (t[0] + 2 > begin.size()) begin.resize(t[0] + 2, 0);
    ++begin[t[0] + 1];
  }
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  std::vector<LabelledCell> sorted(mesh.tetrahedra.size());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    sorted[begin[mesh.tetrahedra[i][0]]++] = {mesh.tetrahedra[i], mesh.regions[i]};
  // By now each entry of `begin` is where the bucket of its vertex ends.
  std::uint32_t first = 0;
  for (const std::uint32_t last : begin) {
    std::sort(sorted.begin() + first, sorted.begin() + last,
              [](const LabelledCell& a, const LabelledCell& b) { return a.vertices < b.vertices; });
    first = last;
  }
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    mesh.tetrahedra[i] = sorted[i].vertices;
    mesh.regions[i] = sorted[i].region;
  }
}

}  // namespace ccdt
