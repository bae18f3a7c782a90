#pragma once

#include <cstdint>

namespace ccdt::io {

/// Gmsh's types of elements.
constexpr std::int32_t gmsh_line = 1, gmsh_triangle = 2, gmsh_tetrahedron = 4, gmsh_point = 15;

}  // namespace ccdt::io
