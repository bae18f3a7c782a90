#pragma once

#include <array>
#include <vector>

#include "bench/verify/topology.h"
#include "bench/verify/verify.h"
#include "engine/base/progress.h"

namespace ccdt::verify {

/// Every inner face that stands for no facet is locally Delaunay: the vertex behind it is not strictly inside the
/// circumsphere of the tetrahedron before it. By the Delaunay lemma for constrained Delaunay tetrahedralizations the
/// mesh is then one (Shewchuk 2008).
///
/// The coordinates that a mesher worked with may differ from those in the mesh, because it rounds them. A violation is
/// explained by that if moving each coordinate by `rounding` can change the sign of the determinant (to first order).
///
/// \param constrained  of each face: does it stand for a facet?
/// \param rounding     in units of the input
/// \param required     must the mesh be constrained Delaunay?
/// \return             faces that are not locally Delaunay beyond what rounding explains, and those within (not
/// required)
std::array<Check, 2> check_delaunay(const Topology& topology, const std::vector<bool>& constrained, double rounding,
                                    bool required, const Progress& progress);

}  // namespace ccdt::verify
