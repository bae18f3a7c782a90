#include "engine/mesh/boundary_faces.h"

#include <algorithm>
#include <utility>

#include "engine/base/simplex_map.h"

namespace ccdt::mesh {

using Face = std::array<std::uint32_t, 3>;

std::array<Face, 4> outward_faces_of(const TetMesh& mesh, std::uint32_t tetrahedron) {
  const std::array<std::uint32_t, 4>& t = mesh.tetrahedra[tetrahedron];
  const auto [a, b, c, d] =
      std::array{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]};
  auto faces = outward_faces(t);
  if (dot(cross(b - a, c - a), d - a) < 0)
    for (Face& face : faces) std::swap(face[1], face[2]);
  return faces;
}

std::vector<Face> boundary_faces(const TetMesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(4 * mesh.tetrahedra.size());
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (const Face& face : outward_faces_of(mesh, t)) faces.push_back(face);
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
