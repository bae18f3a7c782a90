#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/experiments/small_plcs/small_plc.h"

namespace ccdt {

/// What one interior point did to small random PLCs of a family that have a constrained Delaunay tetrahedralization.
struct ExistenceTrials {
  std::string family;
  std::uint64_t cases = 0;
  std::uint64_t lost = 0;               ///< that have none with the point
  small::SmallPlc counterexample = {};  ///< of these the first with the fewest vertices; the point is its last vertex
};

/// The PLC with a point inside, strictly and in general position; empty if `tries` draws have found none.
/// \param seed  of the draws
small::SmallPlc with_interior_point(const small::SmallPlc& plc, std::uint64_t seed);

/// Looks for existence by exhaustion, without and with the point, in so many PLCs of each family in general position.
std::vector<ExistenceTrials> try_interior_points(std::uint64_t cases_a_family);

}  // namespace ccdt
