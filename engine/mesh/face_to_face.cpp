#include "engine/mesh/face_to_face.h"

#include <cstdint>

#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/delaunay/delaunay.h"

namespace ccdt::mesh {

bool is_face_to_face(const TetMesh& mesh) {
  HashTable<FaceKey, std::uint8_t> sides;  // that have a tetrahedron
  for (const auto& t : mesh.tetrahedra)
    for (std::uint32_t f = 0; f < 4; ++f) {
      const auto [a, b, c] = delaunay::corners_of_face({t[0], t[1], t[2], t[3]}, f);
      const bool is_odd = ((a > b) != (b > c)) != (a > c);
      const auto side = static_cast<std::uint8_t>(is_odd ? 1 : 2);
      const auto [known, is_new] = sides.insert(face_key(a, b, c), side);
      if (is_new) continue;
      if ((*known & side) != 0) return false;
      *known |= side;
    }
  return true;
}

}  // namespace ccdt::mesh
