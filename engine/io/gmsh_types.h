#pragma once

#include <cstdint>

namespace ccdt::io {

/// Gmsh's types of elements.
constexpr std::int32_t gmsh_line = 1, gmsh_triangle = 2, gmsh_tetrahedron = 4, gmsh_point = 15;

/// The type with a node in the middle of each edge.
constexpr std::int32_t second_order_of(std::int32_t type) {
  return type == gmsh_line ? 8 : type == gmsh_triangle ? 9 : 11;
}

}  // namespace ccdt::io
