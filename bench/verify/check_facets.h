#pragma once

#include "bench/verify/covers.h"
#include "bench/verify/verify.h"

namespace ccdt::verification {

/// Every input vertex in or on the domain is a vertex of the mesh, unless it may slide.
Check check_vertices(const InputPlc& input, const Surface& surface, const Regions& regions, const RayShooter& rays);

/// Every segment and every feature edge in or on the domain is a chain of mesh edges.
Check check_segments(const Surface& surface, const Chains& edges, const Chains& segments,
                     const std::vector<bool>& features, const Regions& regions, const RayShooter& rays);

/// Every facet that the domain touches is there: as a boundary if one side is inside, else as inner faces.
Check check_facets(const Surface& surface, const Covers& covers, const Regions& regions);

/// Every boundary face of the mesh stands for an input facet.
Check check_boundary(const TetMesh& mesh, const Topology& topology, const Covers& covers);

}  // namespace ccdt::verification
