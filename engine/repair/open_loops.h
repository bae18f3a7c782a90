#pragma once

#include <vector>

#include "engine/base/index.h"
#include "engine/plc/edge_table.h"

namespace ccdt::repair {

/// The edges with one triangle, as chains of vertices.
struct OpenEdges {
  std::vector<std::vector<VertexId>> loops;   ///< closed, each with different vertices: the rims of holes
  std::vector<std::vector<VertexId>> chains;  ///< from one end to another: the rims of flaps
};

/// Divides the open edges into chains. Each edge is in one of them.
OpenEdges find_open_edges(const plc::EdgeTable& edges);

}  // namespace ccdt::repair
