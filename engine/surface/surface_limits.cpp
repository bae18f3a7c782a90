#include "engine/surface/surface_limits.h"

#include <algorithm>
#include <cmath>

namespace ccdt {

bool runs_along_surface(const WorkingMesh& m, VertexHandle a, VertexHandle b) {
  constexpr double most_sine = 0.55;  // of 2 atan(2 most_deviation)
  const Point3 along = m.point(b) - m.point(a);
  const double limit = most_sine * length(along);
  return std::fabs(dot(along, m.at(a).normal)) <= limit && std::fabs(dot(along, m.at(b).normal)) <= limit;
}

bool is_near_surface(const WorkingMesh& m, VertexHandle a, const Point3& q, double most) {
  if (m.is_flat(a)) return true;
  const Point3 p = m.point(a);
  return m.closest.is_within(most * std::max(length(q - p), m.at(a).wanted), m.at(a).patch, 0.5 * (p + q),
                             m.at(a).near);
}

}  // namespace ccdt
