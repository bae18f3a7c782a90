#pragma once

#include "bench/verify/match_facets.h"
#include "bench/verify/verify.h"

namespace ccdt::verify {

/// A mesh that lists faces lists the boundary: each boundary face once, and nothing that is no face of a tetrahedron.
/// Without any listed face nothing is checked.
Check check_listed_faces(const Topology& topology);

/// The listed faces that stand for input facets have the markers of these. Facets without a marker (0) do not matter,
/// since programs fill in what they like. Of facets in one place any marker will do.
Check check_face_markers(const Topology& topology, const Surface& surface, const FacetMatches& matches);

}  // namespace ccdt::verify
