#pragma once

#include "bench/verify/patches.h"
#include "bench/verify/verify.h"

namespace ccdt::verify {

inline constexpr const char* listed_edges_check = "listed edges";

/// The edges of the surface in the mesh.
struct SurfaceEdges {
  std::vector<bool> features;  ///< of each edge of the surface, see `find_features`
  Chains edges, segments;      ///< along the edges and the segments of the surface
};

/// A mesh that lists edges lists those along the segments and the features of its surface, each once, and none that is
/// on no facet. It may also list all its edges.
///
/// \param required  is it wrong if the mesh lists no edges at all? Only if segments of the input have markers
Check check_listed_edges(const plc::InputPlc& input, const Topology& topology, const Surface& surface,
                         const SurfaceEdges& lines, bool required);

/// The listed edges on segments of the input have the markers of these. Segments without a marker (0) are skipped. If
/// several segments coincide, any of their markers is accepted.
Check check_edge_markers(const plc::InputPlc& input, const Topology& topology, const Surface& surface);

}  // namespace ccdt::verify
