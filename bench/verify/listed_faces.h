#pragma once

#include "bench/verify/match_facets.h"
#include "bench/verify/verify.h"

namespace ccdt::verify {

inline constexpr const char* listed_facets_check = "listed facets";

/// A mesh that lists faces lists the boundary: each boundary face once, and only faces of tetrahedra. Without listed
/// faces, nothing is checked.
Check check_listed_faces(const Topology& topology);

/// The mesh lists all faces on input facets, the boundary or not, and no other inner faces.
///
/// \param required  is it wrong if the mesh lists no faces at all?
Check check_listed_facets(const Topology& topology, const FacetMatches& matches, bool required);

/// The listed faces on input facets have the markers of these facets. Facets without a marker (0) are skipped, because
/// programs fill in any value. If several facets coincide, any of their markers is accepted. A mesh without markers is
/// not compared.
Check check_face_markers(const Topology& topology, const Surface& surface, const FacetMatches& matches);

}  // namespace ccdt::verify
