#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/simplex_map.h"
#include "engine/plc/build_plc.h"

namespace ccdt::repair {

/// A part of an edge, as in `WeldedEdge`; or a cut between two vertices, which is treated like an edge.
struct Piece {
  std::uint32_t triangle;
  VertexId a, b, from, to;
};

/// The cuts of a round, between vertices.
struct VertexCuts {
  std::vector<Piece> pieces;     ///< within triangles, by triangle
  std::vector<AtEdge> on_edges;  ///< the new vertices of edges
};

inline std::uint64_t key_of_edge(const plc::VertexTriple& t, std::size_t k) {
  return edge_key(t[k], t[plc::next_corner(k)]);
}

/// Replaces the triangles that have pieces, or vertices on their edges, by smaller ones that contain these. Segments
/// are divided with their edges.
void cut_along(VertexCuts cuts, plc::UncheckedPlc& soup);

}  // namespace ccdt::repair
