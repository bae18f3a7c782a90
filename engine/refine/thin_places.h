#pragma once

#include <vector>

#include "engine/base/point.h"
#include "engine/plc/plc.h"

namespace ccdt::refine {

/// A place and the wanted edge length there.
struct SizedPoint {
  Point3 point;
  double size;
};

/// The places where edges must be shorter than a length: on short segments, where two segments of a facet are near to
/// each other (strips) and where the domain is thin between two facets (walls).
///
/// Facets and segments that meet are not near to each other in this sense: at a small angle the length would go to
/// zero.
///
/// Where strips and walls are so thin, or segments so short, that the mesh would get far too many tetrahedra, the
/// thinnest count as thicker and the shortest as longer.
///
/// \param largest          the length, in grid units
/// \param most_tetrahedra  about so many come of these places
std::vector<SizedPoint> find_thin_places(const plc::Plc& plc, double largest, double most_tetrahedra);

/// The least of the places of about one size that are near each other relative to it.
std::vector<SizedPoint> thinned(const std::vector<SizedPoint>& places);

}  // namespace ccdt::refine
