#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "engine/base/box.h"
#include "engine/lattice/domain_surface.h"

namespace ccdt::lattice {

/// Is the point strictly inside the domain?
///
/// A ray is sent from the point to a triangle within the box. The answer is the flag of the visible side of the nearest
/// triangle hit. Exact (`orient3d`): a ray is replaced by another one if it touches an edge or a vertex, or if its
/// nearest hits cannot be told apart.
///
/// \param p      integer coordinates; in the box
/// \param box    integer coordinates
/// \param nearby at least all triangles that meet the box, and at least one that does
/// \return       nothing if no ray decides; never true if p is on the surface
std::optional<bool> is_inside_by_rays(const Point3& p, const Box& box, const DomainSurface& surface,
                                      std::span<const std::uint32_t> nearby);

/// Finds a point in the part of the triangle that lies in the box, up to rounding; false if there is no such part.
bool common_point(const Box& box, const TrianglePoints& triangle, Point3& point);

}  // namespace ccdt::lattice
