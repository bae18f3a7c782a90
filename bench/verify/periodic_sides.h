#pragma once

#include "bench/verify/topology.h"
#include "bench/verify/verify.h"

namespace ccdt::verify {

/// Along the given axes, the boundary faces on the side of the least coordinate are those on the side of the greatest
/// one, moved along the axis. Faces with all corners in these planes are on a side.
///
/// \param tolerance  how far corners may be from the plane and from each other, in units of the input
Check check_periodic_sides(const Topology& topology, plc::Periodicity periodic, double tolerance);

}  // namespace ccdt::verify
