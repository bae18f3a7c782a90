#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "engine/mesh/tet_mesh.h"
#include "engine/plc/input.h"

namespace ccdt {

/// A mesh and its input.
struct MeshedInput {
  plc::InputPlc input;
  mesh::TetMesh mesh;
};

/// Region of the unit cube with a lowest corner, or `outside`.
using CubeRegion = std::function<int(int, int, int)>;
using Transform = std::function<Point3(const Point3&)>;
inline constexpr int outside = -1;

/// Cubes of a grid, each cut into the six tetrahedra of Kuhn's subdivision. The input has the squares between cubes of
/// different regions as two triangles each.
///
/// \param turned_diagonals  the squares of the input have the other diagonals
MeshedInput make_grid_mesh(const std::array<int, 3>& size, const CubeRegion& region, bool turned_diagonals,
                           const Transform& transform);

inline Point3 unmoved(const Point3& p) {
  return p;
}

/// A rotation that leaves no plane of the grid exactly flat.
Point3 rotated(const Point3& p);

}  // namespace ccdt
