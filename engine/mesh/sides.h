#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "engine/base/simplex_map.h"
#include "engine/mesh/boundary_faces.h"
#include "engine/mesh/tet_mesh.h"

namespace ccdt::mesh {

/// A face of a tetrahedron.
struct Side {
  FaceKey key;
  std::uint32_t tetrahedron;
  std::uint32_t face;  ///< of its `outward_faces`

  bool operator<(const Side& o) const {
    return std::tie(key, tetrahedron, face) < std::tie(o.key, o.tetrahedron, o.face);
  }
};

/// All faces of all tetrahedra; equal ones are side by side.
inline std::vector<Side> sorted_sides(const TetMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(4 * mesh.tetrahedra.size());
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const auto faces = outward_faces(mesh.tetrahedra[t]);
    for (std::uint32_t f = 0; f < 4; ++f) sides.push_back({face_key(faces[f][0], faces[f][1], faces[f][2]), t, f});
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

}  // namespace ccdt::mesh
