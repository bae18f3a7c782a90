#pragma once

#include "engine/plc/plc.h"
#include "engine/sizes/size_field.h"
#include "engine/sizes/wanted_sizes.h"

namespace ccdt::sizes {

/// The edge lengths of a surface: `largest`, and less on short segments, where two segments of a facet are near each
/// other (strips), and where the domain is thin between two facets (walls). From there they grow with the grading.
///
/// Facets and segments that meet do not count as near each other: at a small angle, the length would go to zero.
///
/// If strips and walls are so thin, or segments so short, that the surface would get far more triangles than with edges
/// of the largest length, then the thinnest count as thicker and the shortest as longer.
///
/// \param largest         in grid units
/// \param wanted          what the user wants besides: the least of all lengths counts
/// \param most_triangles  about how many triangles these places may cause
SizeField find_thin_places(const plc::Plc& plc, double largest, double grading, const WantedSizes& wanted,
                           double most_triangles);

}  // namespace ccdt::sizes
