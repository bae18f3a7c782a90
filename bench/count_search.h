#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace ccdt::bench {

/// Within which an edge length is looked for that makes a wanted number of tetrahedra.
struct CountSearch {
  double wanted = 0;    ///< tetrahedra
  double first = 0;     ///< edge length that is tried first
  double shortest = 0;  ///< edge lengths that may be tried
  double longest = 1e300;
  double tolerance = 0.05;  ///< of the number, as a fraction: near enough
  int most_tries = 8;
};

/// The try that came nearest.
struct CountFound {
  double edge_length = 0;
  double count = 0;
  bool is_near = false;  ///< within the tolerance
};

/// Looks for an edge length by the secant through the logarithms of the last two tries (the number of tetrahedra is
/// nearly a power of the edge length, and the third negative one at first), held within what earlier tries enclose. The
/// last try is the one that came near, if any did.
///
/// It ends when longer edges make hardly fewer tetrahedra.
///
/// \param count_of  tetrahedra at an edge length; none if the mesher failed there, which ends the search
/// \return          none if no try has gone well
std::optional<CountFound> search_edge_length(const CountSearch& search,
                                             const std::function<std::optional<std::uint64_t>(double)>& count_of);

}  // namespace ccdt::bench
