#pragma once

#include "bench/verify/topology.h"
#include "bench/verify/verify.h"

namespace ccdt::verify {

/// No two vertices that tetrahedra use have the same position. Failures are in the order of the positions.
Check check_distinct_vertices(const Topology& topology);

}  // namespace ccdt::verify
