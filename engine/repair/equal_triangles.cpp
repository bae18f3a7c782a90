#include "engine/repair/equal_triangles.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/plc/gather_parts.h"

namespace ccdt::repair {
namespace {

using plc::TriangleSet;

/// Which triangles stay, and for each of them: is it one of several that cancel out, because they face opposite ways?
struct Different {
  std::vector<char> is_kept, cancels;
};

Different find_different(const TriangleSet& triangles) {
  HashTable<FaceKey, std::uint32_t> known;
  known.reserve(triangles.size());
  std::vector<int> balance(triangles.size(), 0);
  Different result;
  result.is_kept.resize(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles.corners[t];
    const auto [first, is_new] = known.insert(face_key(a, b, c), t);
    result.is_kept[t] = is_new;
    balance[*first] += is_odd(a, b, c) ? -1 : 1;
  }
  result.cancels.resize(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) result.cancels[t] = result.is_kept[t] && balance[t] == 0;
  return result;
}

/// The triangles that are left at an edge.
struct EdgeTriangles {
  std::uint32_t count = 0;
  std::uint32_t all = 0;  ///< their numbers, combined by exclusive or; the number itself if there is one triangle
};

template <class Visit>
void for_each_edge(const plc::VertexTriple& t, const Visit& visit) {
  for (std::size_t k = 0; k < 3; ++k) visit(edge_key(t[k], t[plc::next_corner(k)]));
}

void drop_fins(const TriangleSet& triangles, Different& different) {
  HashTable<std::uint64_t, EdgeTriangles> edges;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (different.is_kept[t])
      for_each_edge(triangles.corners[t], [&](std::uint64_t edge) {
        EdgeTriangles& at = *edges.insert(edge).first;
        ++at.count;
        at.all ^= t;
      });
  std::vector<std::uint32_t> open;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (different.cancels[t]) open.push_back(t);
  while (!open.empty()) {
    const std::uint32_t t = open.back();
    open.pop_back();
    bool is_free = false;
    for_each_edge(triangles.corners[t], [&](std::uint64_t edge) { is_free |= edges.find(edge)->count == 1; });
    if (!is_free || !different.is_kept[t]) continue;
    different.is_kept[t] = 0;
    for_each_edge(triangles.corners[t], [&](std::uint64_t edge) {
      EdgeTriangles& at = *edges.find(edge);
      --at.count;
      at.all ^= t;
      if (at.count == 1 && different.cancels[at.all]) open.push_back(at.all);
    });
  }
}

}  // namespace

std::size_t drop_equal_triangles(TriangleSet& triangles, Fins fins) {
  Different different = find_different(triangles);
  if (std::ranges::find(different.is_kept, 0) == different.is_kept.end()) return 0;
  if (fins == Fins::drop) drop_fins(triangles, different);
  const std::size_t before = triangles.size();
  plc::keep_triangles(different.is_kept, triangles);
  return before - triangles.size();
}

}  // namespace ccdt::repair
