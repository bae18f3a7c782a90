#pragma once

#include <cstdint>
#include <functional>
#include <optional>

namespace ccdt::bench {

/// The bounds of a search for the edge length that makes a wanted number of tetrahedra.
struct CountSearch {
  double wanted = 0;    ///< tetrahedra
  double first = 0;     ///< edge length that is tried first
  double shortest = 0;  ///< edge lengths that may be tried
  double longest = 1e300;
  double tolerance = 0.05;  ///< relative tolerance of the number
  int most_tries = 8;
};

/// The best try.
struct CountFound {
  double edge_length = 0;
  double count = 0;
  bool is_near = false;  ///< within the tolerance
};

/// Searches for an edge length by the secant through the logarithms of the last two tries, within the bounds from
/// earlier tries. The number of tetrahedra is nearly a power of the edge length, initially with exponent -3. The last
/// try is the one within the tolerance, if there is one.
///
/// It ends when longer edges make hardly fewer tetrahedra.
///
/// \param count_of  tetrahedra at an edge length; none if the mesher failed there, which ends the search
/// \return          none if no try succeeded
std::optional<CountFound> search_edge_length(const CountSearch& search,
                                             const std::function<std::optional<std::uint64_t>(double)>& count_of);

}  // namespace ccdt::bench
