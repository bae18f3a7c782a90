#include "engine/plc/edge_table.h"

#include <algorithm>

namespace ccdt {

namespace {

struct HalfEdge {
  std::uint64_t key;   // smaller end in the upper half, greater end in the lower
  std::uint32_t slot;  // 3 * triangle + corner
};

std::uint64_t key_of(std::uint32_t a, std::uint32_t b) {
  return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

}  // namespace

EdgeTable make_edge_table(std::span<const Corners> triangles) {
  std::vector<HalfEdge> halves;
  halves.reserve(triangles.size() * 3);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k)
      halves.push_back({key_of(triangles[t][k], triangles[t][(k + 1) % 3]), 3 * t + k});
  std::sort(halves.begin(), halves.end(),
            [](const HalfEdge& a, const HalfEdge& b) { return a.key != b.key ? a.key < b.key : a.slot < b.slot; });

  EdgeTable table;
  table.triangles.resize(halves.size());
  table.edges_of.resize(triangles.size());
  for (std::uint32_t i = 0; i < halves.size(); ++i) {
    const auto [key, slot] = halves[i];
    if (i == 0 || halves[i - 1].key != key) {
      table.ends.push_back({VertexId(key >> 32), VertexId(key & 0xFFFFFFFFu)});
      table.first.push_back(i);
    }
    table.triangles[i] = slot / 3;
    table.edges_of[slot / 3][slot % 3] = table.size() - 1;
  }
  table.first.push_back(static_cast<std::uint32_t>(halves.size()));
  return table;
}

std::uint32_t EdgeTable::find(VertexId a, VertexId b) const {
  const std::array<VertexId, 2> sought = {std::min(a, b), std::max(a, b)};
  const auto at = std::lower_bound(ends.begin(), ends.end(), sought);
  return at != ends.end() && *at == sought ? static_cast<std::uint32_t>(at - ends.begin()) : none;
}

}  // namespace ccdt
