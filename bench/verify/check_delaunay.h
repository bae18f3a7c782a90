#pragma once

#include <array>
#include <vector>

#include "bench/verify/topology.h"
#include "bench/verify/verify.h"
#include "engine/base/progress.h"

namespace ccdt::verify {

/// Every inner face that is not part of a facet is locally Delaunay: the vertex behind it is not strictly inside the
/// circumsphere of the tetrahedron before it. By the Delaunay lemma (Shewchuk 2008), the mesh is then a constrained
/// Delaunay tetrahedralization.
///
/// The coordinates with which a mesher worked may differ from those in the mesh by rounding. Rounding explains a
/// violation if moving each coordinate by `rounding` can change the sign of the determinant.
///
/// \param constrained  by face: is it part of a facet?
/// \param rounding     in units of the input
/// \param required     must the mesh be constrained Delaunay?
/// \return             faces that are not locally Delaunay beyond what rounding explains, and those within (not
/// required)
std::array<Check, 2> check_delaunay(const Topology& topology, const std::vector<bool>& constrained, double rounding,
                                    bool required, const Progress& progress);

}  // namespace ccdt::verify
