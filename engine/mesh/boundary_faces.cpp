#include "engine/mesh/boundary_faces.h"

#include <algorithm>
#include <utility>

#include "engine/base/simplex_map.h"

namespace ccdt::mesh {

namespace {

using Face = std::array<std::uint32_t, 3>;

/// The corners of a tetrahedron that face away from it, for either orientation of the tetrahedron.
std::array<Face, 4> faces_of(const TetMesh& mesh, std::array<std::uint32_t, 4> t) {
  const auto [a, b, c, d] =
      std::array{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]};
  if (dot(cross(b - a, c - a), d - a) < 0) std::swap(t[2], t[3]);
  return outward_faces(t);
}

}  // namespace

std::vector<Face> boundary_faces(const TetMesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(4 * mesh.tetrahedra.size());
  for (const auto& tetrahedron : mesh.tetrahedra)
    for (const Face& face : faces_of(mesh, tetrahedron)) faces.push_back(face);
  std::vector<FaceKey> keys;
  keys.reserve(faces.size());
  for (const auto& [a, b, c] : faces) keys.push_back(face_key(a, b, c));
  std::ranges::sort(keys);
  std::erase_if(faces, [&](const Face& face) {
    const auto same = std::ranges::equal_range(keys, face_key(face[0], face[1], face[2]));
    return same.size() > 1;
  });
  return faces;
}

}  // namespace ccdt::mesh
