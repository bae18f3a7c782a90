#include "engine/improve/upright_faces.h"

#include <cmath>

#include "engine/numbers/predicates.h"
#include "engine/plc/integer_points.h"

namespace ccdt::improve {

Point3 axis_above(const Point3& a, const Point3& b, const Point3& c) {
  const Point3 normal = cross(b - a, c - a);
  std::array<double, 3> axis{};
  const int longest = plc::dominant_axis(normal);
  axis[longest] = std::copysign(1, as_array(normal)[longest]);
  return {axis[0], axis[1], axis[2]};
}

bool is_upright(const CellComplex& x, const std::array<std::uint32_t, 3>& corners, const Point3& axis) {
  const auto& [a, b, c] = corners;
  return numbers::orient3d(x.point(a), x.point(b), x.point(c), x.point(a) + axis) > 0;
}

}  // namespace ccdt::improve
