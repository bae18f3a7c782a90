#pragma once

#include <span>
#include <vector>

#include "engine/plc/plc.h"
#include "engine/sizes/size_tree.h"

namespace ccdt::sizes {

/// The places where edges must be shorter than a length: on short segments, where two segments of a facet are near each
/// other (strips), and where the domain is thin between two facets (walls).
///
/// Facets and segments that meet do not count as near each other: at a small angle, the length would go to zero.
///
/// Where strips and walls are so thin, or segments so short, that the mesh would get far too many tetrahedra, the
/// thinnest count as thicker and the shortest as longer.
///
/// \param largest          the length, in grid units
/// \param most_tetrahedra  about how many these places may lead to
std::vector<SizedPlace> find_thin_places(const plc::Plc& plc, double largest, double most_tetrahedra);

/// Raises the sizes of places to at least this. Of those that then have about the same size and are near each other
/// relative to it, only the least stay.
std::vector<SizedPlace> limited_from_below(std::vector<SizedPlace> places, double least);

/// The limit from below that leaves about this share of the vertices at the places; `largest` if none does.
///
/// \param least  the present limit
double limit_for_share(std::span<const SizedPlace> places, double share, double least, double largest);

}  // namespace ccdt::sizes
