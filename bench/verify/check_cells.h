#pragma once

#include "bench/verify/topology.h"
#include "bench/verify/verify.h"

namespace ccdt::verification {

/// Coordinates are finite.
Check check_coordinates(const TetMesh& mesh);

/// Every tetrahedron has four different vertices that exist, and attribute arrays have one entry an element.
Check check_indices(const TetMesh& mesh);

/// Every tetrahedron is positively oriented, exactly.
Check check_orientation(const TetMesh& mesh, const Progress& progress);

/// No two vertices that tetrahedra use are in one place.
Check check_distinct_vertices(const TetMesh& mesh, const Topology& topology);

/// Every vertex is used by a tetrahedron (not required).
Check check_used_vertices(const TetMesh& mesh, const Topology& topology);

/// Every face is of one tetrahedron, or of two on opposite sides.
Check check_shared_faces(const TetMesh& mesh, const Topology& topology);

}  // namespace ccdt::verification
