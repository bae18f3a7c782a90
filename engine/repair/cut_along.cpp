#include "engine/repair/cut_along.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/repair/cut_triangle.h"
#include "engine/repair/edge_chains.h"

namespace ccdt::repair {
namespace {

using plc::TriangleSet;

constexpr std::size_t most_attempts = 4;  // to find all vertices of edges

/// Appends a piece, divided where its edge is divided.
void append_divided(const Piece& piece, const EdgeChains& chains, std::vector<std::array<VertexId, 2>>& parts) {
  std::vector<VertexId> chain = chains.between(piece.a, piece.b);
  chain.insert(chain.begin(), piece.a);
  chain.push_back(piece.b);
  const auto begin = std::ranges::find(chain, piece.from), end = std::find(begin, chain.end(), piece.to);
  if (end == chain.end() || chain.size() == 2) {
    parts.push_back({piece.from, piece.to});
    return;
  }
  for (auto v = begin; v != end; ++v) parts.push_back({*v, *(v + 1)});
}

/// The triangles that get parts, in increasing order, and their parts.
struct Parts {
  std::vector<std::uint32_t> triangles;
  std::vector<TriangleParts> parts;
};

Parts cut_triangles(const plc::UncheckedPlc& soup, const VertexCuts& cuts, const EdgeChains& chains) {
  const auto& corners = soup.triangles.corners;
  std::vector<std::uint32_t> first(corners.size() + 1, 0);  // pieces of each triangle
  for (const Piece& piece : cuts.pieces) ++first[piece.triangle + 1];
  for (std::size_t t = 0; t < corners.size(); ++t) first[t + 1] += first[t];
  Parts result;
  result.triangles = parallel_select(corners.size(), 4096, [&](std::size_t t) {
    const auto& [a, b, c] = corners[t];
    return first[t] < first[t + 1] || chains.has(a, b) || chains.has(b, c) || chains.has(c, a);
  });
  result.parts.resize(result.triangles.size());
  parallel_for(result.triangles.size(), 16, [&](std::size_t i) {
    const std::uint32_t t = result.triangles[i];
    const auto& [a, b, c] = corners[t];
    DividedTriangle triangle{corners[t], {chains.between(a, b), chains.between(b, c), chains.between(c, a)}, {}};
    for (std::uint32_t p = first[t]; p < first[t + 1]; ++p) append_divided(cuts.pieces[p], chains, triangle.pieces);
    result.parts[i] = cut_triangle(soup.plc.vertices, triangle);
  });
  return result;
}

/// Puts vertices that rounding moved beyond an edge onto that edge. Were there any?
bool add_vertices_of_edges(const TriangleSet& triangles, const Parts& parts, VertexCuts& cuts) {
  const std::size_t before = cuts.on_edges.size();
  for (std::size_t i = 0; i < parts.triangles.size(); ++i)
    for (const auto& [k, v] : parts.parts[i].beyond_edges)
      cuts.on_edges.push_back({key_of_edge(triangles.corners[parts.triangles[i]], k), v});
  return cuts.on_edges.size() > before;
}

void replace_triangles(const Parts& parts, TriangleSet& triangles) {
  TriangleSet result;
  std::size_t next = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (next == parts.triangles.size() || parts.triangles[next] != t) {
      result.add(triangles.corners[t], triangles.markers[t], triangles.numbers[t], triangles.faces[t]);
      continue;
    }
    for (const plc::VertexTriple& part : parts.parts[next++].triangles)
      result.add(part, triangles.markers[t], triangles.numbers[t]);
  }
  triangles = std::move(result);
}

void divide_segments(const EdgeChains& chains, plc::SegmentSet& segments) {
  plc::SegmentSet result;
  for (std::uint32_t s = 0; s < segments.size(); ++s) {
    const auto [a, b] = segments.ends[s];
    VertexId last = a;
    for (const VertexId v : chains.between(a, b)) {
      result.add(last, v, segments.markers[s]);
      last = v;
    }
    result.add(last, b, segments.markers[s]);
  }
  segments = std::move(result);
}

}  // namespace

void cut_along(VertexCuts cuts, plc::UncheckedPlc& soup) {
  for (std::size_t attempt = 1;; ++attempt) {
    const EdgeChains chains(soup.plc.vertices, cuts.on_edges);
    const Parts parts = cut_triangles(soup, cuts, chains);
    if (attempt < most_attempts && add_vertices_of_edges(soup.triangles, parts, cuts)) continue;
    replace_triangles(parts, soup.triangles);
    divide_segments(chains, soup.segments);
    return;
  }
}

}  // namespace ccdt::repair
