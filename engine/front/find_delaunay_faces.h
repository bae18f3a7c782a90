#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/index.h"
#include "engine/delaunay/delaunay.h"

namespace ccdt::front {

/// The face protection check (paper, section 5.2): for every triangle its code in the cell above it, if it is a face of
/// the Delaunay tetrahedralization; `no_neighbor` if it is undelaunay.
///
/// \param triangles  pairwise different
std::vector<std::uint32_t> find_delaunay_faces(const std::vector<std::array<VertexId, 3>>& triangles,
                                               const delaunay::Delaunay& delaunay);

/// By triangle: is it no face of the tetrahedralization?
std::vector<std::uint8_t> find_undelaunay_triangles(const std::vector<std::array<VertexId, 3>>& triangles,
                                                    const delaunay::Delaunay& delaunay);

}  // namespace ccdt::front
