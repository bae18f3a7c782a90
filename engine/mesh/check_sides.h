#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/base/point.h"
#include "engine/plc/plc.h"

namespace ccdt::mesh {

/// Checks that opposite sides of the mesh of a periodic PLC have the same faces.
///
/// \param points  of the mesh, in grid units
/// \param faces   of the mesh
/// \throw MeshError  with the place of a face that is on one side alone
void check_sides(const plc::Plc& plc, std::span<const Point3> points,
                 std::span<const std::array<std::uint32_t, 3>> faces);

}  // namespace ccdt::mesh
