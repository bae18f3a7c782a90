#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "engine/lattice/surface.h"

namespace ccdt {

/// Is the point strictly inside the domain?
///
/// The point looks at a triangle within the box; the nearest triangle that its sight hits tells by the flag of the side
/// that it shows. Exact
/// (`orient3d`): a sight that touches an edge or a vertex, or whose nearest hits cannot be told apart, is given up for
/// another.
///
/// \param p      integer coordinates; in the box
/// \param box    integer coordinates
/// \param nearby at least all triangles that meet the box, and at least one that does
/// \return       nothing if no sight decides; never true if p is on the surface
std::optional<bool> sees_inside(const Point3& p, const Box& box, const Surface& surface,
                                std::span<const std::uint32_t> nearby);

}  // namespace ccdt
