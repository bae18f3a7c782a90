#pragma once

#include "bench/verify/regions.h"
#include "bench/verify/verify.h"

namespace ccdt::verify {

/// Compares a mesh that has its own surface with the input: both have the same parts of the domain and the same spaces
/// outside, no point of the boundary and of the inner facets of one is farther from those of the other than the limit,
/// and the volumes differ by no more than a layer of that thickness on the boundary. Faces between regions are facets
/// of the mesh, and so are the faces that it lists. Facets of the input that do not touch the domain do not count.
///
/// \param boundary  of the mesh
/// \param surface   of the input, with its regions
/// \pre    the boundary encloses the tetrahedra once and does not cross itself
/// \param result   has the volumes; gets the checks and the distances
void check_within(const plc::InputPlc& input, const Topology& topology, const plc::InputPlc& boundary,
                  const Surface& surface, const Regions& regions, double limit, Verification& result);

}  // namespace ccdt::verify
