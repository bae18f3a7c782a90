#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/mesh/tet_mesh.h"

namespace ccdt::mesh {

struct LabeledCell {
  std::array<std::uint32_t, 4> vertices;  ///< positively oriented
  int region;                             ///< attribute
};

/// The even permutation with the least vertex first and the least of the others second.
inline std::array<std::uint32_t, 4> in_order(std::array<std::uint32_t, 4> t) {
  const auto least = std::min_element(t.begin(), t.end()) - t.begin();
  if (least != 0) {
    // Two exchanges keep the orientation.
    std::swap(t[0], t[static_cast<std::size_t>(least)]);
    std::swap(least == 1 ? t[2] : t[1], t[3 == least ? 2 : 3]);
  }
  if (t[2] < t[1] && t[2] < t[3]) return {t[0], t[2], t[3], t[1]};
  if (t[3] < t[1]) return {t[0], t[3], t[1], t[2]};
  return t;
}

/// A mesh of some cells, which has nothing else yet. They and the corners of each are in an order that depends on
/// nothing but the set of cells: the mesh is the same, byte for byte, whatever strategy made it and on however many
/// threads. The first corner of each is its least vertex. Tetrahedra that are close in space are mostly close in this
/// order, because interior vertices are numbered along a space-filling curve.
///
/// \param vertices  more than each corner
/// \param cell      `cell(i)`: a `std::optional<LabeledCell>` for each i below `count`; called twice for each
template <class CellAt>
TetMesh sorted_mesh(std::size_t vertices, std::size_t count, const CellAt& cell) {
  constexpr std::size_t grain = 4096;
  const bool alone = thread_count() == 1;
  const auto take_one = [&](std::uint32_t& number) {
    return alone ? number++ : std::atomic_ref(number).fetch_add(1, std::memory_order_relaxed);
  };
  // A counting sort by the least vertex leaves a few cells in each bucket.
  std::vector<std::uint32_t> begin(vertices + 1, 0);
  parallel_for(count, grain, [&](std::size_t i) {
    if (const std::optional<LabeledCell> c = cell(i)) take_one(begin[std::ranges::min(c->vertices) + 1]);
  });
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  RawVector<LabeledCell> sorted(begin.back());
  parallel_for(count, grain, [&](std::size_t i) {
    if (const std::optional<LabeledCell> c = cell(i)) {
      const auto t = in_order(c->vertices);
      sorted[take_one(begin[t[0]])] = {t, c->region};
    }
  });
  TetMesh mesh;
  mesh.tetrahedra.resize(sorted.size());
  mesh.regions.resize(sorted.size());
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
  return mesh;
}

}  // namespace ccdt::mesh
