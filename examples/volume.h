#pragma once

#include <ccdt/ccdt.h>

/// The volume of a tetrahedron of the mesh.
inline double volume(const ccdt::TetMesh& mesh, std::size_t tetrahedron) {
  const auto& [a, b, c, d] = mesh.tetrahedra[tetrahedron];
  const auto& v = mesh.vertices;
  return dot(cross(v[b] - v[a], v[c] - v[a]), v[d] - v[a]) / 6;
}
