#pragma once

#include <array>
#include <cstdint>

#include "engine/improve/cell_complex.h"

/// New faces on a facet must not fold over. Positive cells do not ensure that where a facet is flat only within the
/// tolerance: there are cells with all corners on it. So a facet is seen along an axis, and its faces are *upright* if
/// they turn the same way as the facet.
namespace ccdt::improve {

/// The axis closest to the normal of the facet of a face, on its upper side.
Point3 axis_above(const CellComplex& complex, std::uint32_t face);

/// Exactly: is a triangle upright, seen along an axis, and not yet a face?
bool is_new_and_upright(const CellComplex& complex, const std::array<std::uint32_t, 3>& corners, const Point3& axis);

}  // namespace ccdt::improve
