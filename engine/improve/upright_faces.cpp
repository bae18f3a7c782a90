#include "engine/improve/upright_faces.h"

#include <cmath>

#include "engine/numbers/predicates.h"
#include "engine/plc/integer_points.h"

namespace ccdt::improve {

Point3 axis_above(const CellComplex& x, std::uint32_t face) {
  const Point3& normal = x.normal_of_facet(x.facet_of_face()[face]);
  std::array<double, 3> axis{};
  const int longest = plc::dominant_axis(normal);
  axis[longest] = std::copysign(1, as_array(normal)[longest]);
  return {axis[0], axis[1], axis[2]};
}

bool is_new_and_upright(const CellComplex& x, const std::array<std::uint32_t, 3>& corners, const Point3& axis) {
  const auto& [a, b, c] = corners;
  return !x.find_face(a, b, c) && numbers::orient3d(x.point(a), x.point(b), x.point(c), x.point(a) + axis) > 0;
}

}  // namespace ccdt::improve
