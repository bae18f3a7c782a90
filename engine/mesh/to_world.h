#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/plc/plc.h"

namespace ccdt::mesh {

/// The vertices of a mesh in the units of the input. Input vertices get their original coordinates back wherever every
/// tetrahedron around stays positively oriented in the coordinates that are written, exactly tested; elsewhere they
/// stay where the grid has put them, and where improvement has moved them.
///
/// \param points     grid units; those of the PLC's vertices come first
/// \throw MeshError  a tetrahedron is inverted by writing its vertices as doubles: the part is too far from the origin
std::vector<Point3> to_world(const plc::Plc& plc, std::span<const Point3> points,
                             std::span<const std::array<std::uint32_t, 4>> tetrahedra);

}  // namespace ccdt::mesh
