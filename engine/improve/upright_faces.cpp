#include "engine/improve/upright_faces.h"

#include <cstdlib>

#include "engine/numbers/predicates.h"

namespace ccdt::improve {

Point3 axis_above(const CellComplex& x, std::uint32_t face) {
  const int axis = x.axis_of_facet(x.facet_of_face()[face]);
  const double up = axis > 0 ? 1 : -1;
  switch (std::abs(axis)) {
    case 1:
      return {up, 0, 0};
    case 2:
      return {0, up, 0};
    default:
      return {0, 0, up};
  }
}

bool is_new_and_upright(const CellComplex& x, const std::array<std::uint32_t, 3>& corners, const Point3& axis) {
  const auto& [a, b, c] = corners;
  return !x.find_face(a, b, c) && numbers::orient3d(x.point(a), x.point(b), x.point(c), x.point(a) + axis) > 0;
}

}  // namespace ccdt::improve
