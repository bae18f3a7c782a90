#include <algorithm>
#include <array>

#include "baselines/common.h"

namespace ccdt {
namespace {

/// A face of a tetrahedron, with its vertices as the tetrahedron has them and in order.
struct Side {
  std::array<std::uint32_t, 3> sorted, face;
  int region = 0;
};

std::vector<Side> sides_of(const TetMesh& mesh) {
  // Each seen counterclockwise from outside of a positively oriented tetrahedron.
  constexpr std::array<std::array<std::size_t, 3>, 4> corners = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  std::vector<Side> sides;
  sides.reserve(4 * mesh.tetrahedra.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (const auto& [a, b, c] : corners) {
      const auto& v = mesh.tetrahedra[t];
      Side side{{v[a], v[b], v[c]}, {v[a], v[b], v[c]}, mesh.regions[t]};
      std::ranges::sort(side.sorted);
      sides.push_back(side);
    }
  std::ranges::sort(sides, {}, &Side::sorted);
  return sides;
}

}  // namespace

void add_boundary_faces(TetMesh& mesh) {
  const std::vector<Side> sides = sides_of(mesh);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool has_neighbour = i + 1 < sides.size() && sides[i + 1].sorted == sides[i].sorted;
    if (!has_neighbour || sides[i].region != sides[i + 1].region) mesh.faces.push_back(sides[i].face);
    if (has_neighbour) ++i;
  }
  mesh.face_markers.assign(mesh.faces.size(), 0);
}

}  // namespace ccdt
