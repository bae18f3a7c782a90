#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/improve/smoothing.h"
#include "engine/plc/plc.h"
#include "engine/tets/cell_complex.h"

namespace ccdt::improve {

/// Keeps the sides of a periodic mesh equal: their faces are not exchanged, since each gets a facet of its own.
///
/// \param points  of the mesh, in grid units
void keep_faces_on_sides(const plc::Plc& plc, std::span<const Point3> points,
                         std::span<const std::array<std::uint32_t, 3>> faces,
                         std::vector<std::uint32_t>& facet_of_face);

/// Keeps the vertices on the sides of a periodic mesh where they are.
///
/// \param freedom  of its vertices
void keep_vertices_on_sides(const plc::Plc& plc, const tets::CellComplex& complex, std::vector<Freedom>& freedom);

}  // namespace ccdt::improve
