#include "engine/repair/winding_number.h"

#include <cmath>

#include "engine/base/parallel.h"
#include "engine/base/portable_math.h"

namespace ccdt::repair {
namespace {

/// The solid angle of a triangle seen from the origin, positive if its normal points away (Van Oosterom & Strackee
/// 1983).
double solid_angle(const Point3& a, const Point3& b, const Point3& c) {
  const double la = length(a), lb = length(b), lc = length(c);
  const double spread = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2 * std::atan2(dot(a, cross(b, c)), spread);
}

}  // namespace

double winding_number(const Point3& p, const OrientedSurface& surface) {
  const auto& [vertices, triangles] = surface;
  const auto sums = parallel_chunks(triangles.size(), 4096, [&](std::size_t i, std::size_t end) {
    double sum = 0;
    for (; i < end; ++i) {
      const auto& [a, b, c] = triangles[i];
      sum += solid_angle(vertices[a] - p, vertices[b] - p, vertices[c] - p);
    }
    return sum;
  });
  double sum = 0;
  for (const double part : sums) sum += part;
  return sum / (4 * portable::pi);
}

}  // namespace ccdt::repair
