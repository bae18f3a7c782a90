#include "engine/plc/plane_steps.h"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "engine/geometry/predicates.h"

namespace ccdt::plc {
namespace {

bool is_multiple_of_quantum(const Point3& p) {
  constexpr double quantum = DyadicGrid::quantum;
  const auto whole = [](double x) { return std::nearbyint(x / quantum) * quantum == x; };
  return whole(p.x) && whole(p.y) && whole(p.z);
}

/// Makes the two steps short and nearly orthogonal; their integer combinations stay the same (Lagrange).
void shorten(Point3& u, Point3& v) {
  constexpr int most_rounds = 100;
  for (int round = 0; round < most_rounds; ++round) {
    if (squared_length(v) < squared_length(u)) std::swap(u, v);
    const double times = std::round(dot(u, v) / squared_length(u));
    if (times == 0) return;
    const Point3 shorter = v - times * u;
    if (!(squared_length(shorter) < squared_length(v))) return;
    v = shorter;
  }
}

}  // namespace

Point3 shortest_step(const Point3& from, const Point3& to) {
  const Point3 difference = to - from;
  const auto magnitude = [](double x) { return static_cast<std::int64_t>(std::fabs(x)); };
  const std::int64_t divisor =
      std::gcd(std::gcd(magnitude(difference.x), magnitude(difference.y)), magnitude(difference.z));
  const auto by = static_cast<double>(divisor);  // divides without remainder, so exact
  return {difference.x / by, difference.y / by, difference.z / by};
}

PlaneSteps steps_in_plane(const Point3& a, const Point3& b, const Point3& c) {
  PlaneSteps steps{a, shortest_step(a, b), shortest_step(a, c)};
  shorten(steps.u, steps.v);
  return steps;
}

std::optional<PlaneSteps> steps_of_facet(std::span<const std::array<VertexId, 3>> triangles,
                                         const std::vector<Point3>& points) {
  VertexId a, b;
  for (const auto& triangle : triangles) {
    for (const VertexId v : triangle) {
      if (v == a || v == b || !is_multiple_of_quantum(points[v])) continue;
      if (a.is_none()) {
        a = v;
      } else if (b.is_none()) {
        b = v;
      } else if (!collinear(points[a], points[b], points[v])) {
        return steps_in_plane(points[a], points[b], points[v]);
      }
    }
  }
  return std::nullopt;
}

}  // namespace ccdt::plc
