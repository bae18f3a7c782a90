#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/index.h"
#include "engine/plc/edge_table.h"

namespace ccdt::repair {

/// The edges with one triangle, as chains of vertices.
struct OpenEdges {
  std::vector<std::vector<VertexId>> loops;   ///< closed, each with distinct vertices: the rims of holes
  std::vector<std::vector<VertexId>> chains;  ///< from one end to another: the rims of flaps
};

/// Divides the open edges into chains. Each edge is in one of them.
OpenEdges find_open_edges(const plc::EdgeTable& edges);

/// The triangle at an open edge.
std::uint32_t triangle_at(const plc::EdgeTable& edges, VertexId a, VertexId b);

/// Which rims belong to holes.
enum class Rims {
  of_holes,  ///< loops, and chains closed by an edge with two triangles, where a third triangle is missing
  all        ///< also chains closed by any other edge
};

/// Does an edge between the ends of a chain make it the rim of a hole?
bool is_closed_by_an_edge(const std::vector<VertexId>& chain, const plc::EdgeTable& edges, Rims which);

}  // namespace ccdt::repair
