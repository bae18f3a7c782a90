#include "engine/mesh/sort_tetrahedra.h"

#include <algorithm>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"

namespace ccdt::mesh {
namespace {

using Tetrahedron = std::array<std::uint32_t, 4>;

struct LabeledCell {
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

constexpr std::size_t grain = 4096;

}  // namespace

void sort_tetrahedra(TetMesh& mesh) {
  const std::size_t size = mesh.tetrahedra.size();
  parallel_for(size, grain, [&](std::size_t i) { mesh.tetrahedra[i] = in_order(mesh.tetrahedra[i]); });
  // A counting sort by the first vertex leaves a few cells in each bucket.
  std::uint32_t vertices = 0;
  for (const Tetrahedron& t : mesh.tetrahedra) vertices = std::max(vertices, t[0] + 1);
  std::vector<std::uint32_t> begin(vertices + 1, 0);
  parallel_for(size, grain, [&](std::size_t i) { add_one(begin[mesh.tetrahedra[i][0] + 1]); });
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  RawVector<LabeledCell> sorted(size);
  parallel_for(size, grain, [&](std::size_t i) {
    sorted[add_one(begin[mesh.tetrahedra[i][0]])] = {mesh.tetrahedra[i], mesh.regions[i]};
  });
  // By now each entry of `begin` is where the bucket of its vertex ends.
  parallel_for(vertices, grain, [&](std::size_t v) {
    const std::uint32_t first = v == 0 ? 0 : begin[v - 1];
    std::sort(sorted.begin() + first, sorted.begin() + begin[v],
              [](const LabeledCell& a, const LabeledCell& b) { return a.vertices < b.vertices; });
    for (std::uint32_t i = first; i < begin[v]; ++i) {
      mesh.tetrahedra[i] = sorted[i].vertices;
      mesh.regions[i] = sorted[i].region;
    }
  });
}

}  // namespace ccdt::mesh
