#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/index.h"
#include "engine/delaunay/delaunay.h"

namespace ccdt::front {

/// The face protection check (paper, section 5.2): for every triangle, its code in the cell above it if it is a face of
/// the Delaunay tetrahedralization, or `no_neighbor` if it is undelaunay. Both sides of a plate may have triangles with
/// the same corners; only the first of these gets its code.
std::vector<std::uint32_t> find_delaunay_faces(const std::vector<std::array<VertexId, 3>>& triangles,
                                               const delaunay::Delaunay& delaunay);

/// The same, but fast for triangles that are still the same faces as in an earlier state of the tetrahedralization.
///
/// \param earlier  by triangle: the code of that face in one of its two cells, or `no_neighbor`
std::vector<std::uint32_t> find_delaunay_faces_again(const std::vector<std::array<VertexId, 3>>& triangles,
                                                     const std::vector<std::uint32_t>& earlier,
                                                     const delaunay::Delaunay& delaunay);

}  // namespace ccdt::front
