#pragma once

#include <cstddef>
#include <vector>

#include "engine/improve/smoothing.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::improve {

/// Where the vertices of a mesh may move without changing any facet or segment (`BoundaryRule::slide`):
///
/// - a vertex of the PLC inside one facet, in its plane;
/// - a vertex inside a segment, along it: a Steiner vertex, or a vertex of the PLC where two collinear segments of one
///   marker meet and all facets there contain both;
/// - interior vertices, anywhere;
/// - all others, nowhere: corners, isolated vertices, and vertices on nearly flat facets.
///
/// Straightness and flatness are decided exactly. Vertices of the PLC are multiples of `DyadicGrid::quantum`. So their
/// differences, divided by the quantum, have integer coordinates; these give the steps.
///
/// \param vertices  the number of vertices of the mesh: those of the PLC, Steiner vertices, then interior vertices
std::vector<Freedom> find_freedom(const plc::Plc& plc, const protection::SegmentChains& chains, std::size_t vertices);

}  // namespace ccdt::improve
