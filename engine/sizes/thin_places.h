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
std::vector<SizedPoint> find_thin_places(const plc::Plc& plc, double largest, double most_tetrahedra);

/// Of places that have about the same size and are near each other relative to it, only the least.
std::vector<SizedPoint> thinned(const std::vector<SizedPoint>& places);

}  // namespace ccdt::refine
