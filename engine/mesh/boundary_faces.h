#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/tet_mesh.h"

namespace ccdt::mesh {

/// The faces of a positively oriented tetrahedron, facing away from it. The face k is opposite to the corner k.
constexpr std::array<std::array<std::uint32_t, 3>, 4> outward_faces(const std::array<std::uint32_t, 4>& t) {
  return {{{t[1], t[2], t[3]}, {t[0], t[3], t[2]}, {t[0], t[1], t[3]}, {t[0], t[2], t[1]}}};
}

/// The faces of a tetrahedron of either orientation, facing away from it, in the order of `outward_faces`.
std::array<std::array<std::uint32_t, 3>, 4> outward_faces_of(const TetMesh& mesh, std::uint32_t tetrahedron);

/// The faces that belong to one tetrahedron only, facing away from it, in the order of the tetrahedra.
std::vector<std::array<std::uint32_t, 3>> boundary_faces(const TetMesh& mesh);

}  // namespace ccdt::mesh
