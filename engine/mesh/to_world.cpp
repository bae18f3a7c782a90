#include "engine/mesh/to_world.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "engine/base/errors.h"

namespace ccdt::mesh {
namespace {

using Tetrahedron = std::array<std::uint32_t, 4>;
using Rational = boost::multiprecision::cpp_rational;

bool is_positive_exactly(const std::array<const Point3*, 4>& p) {
  std::array<std::array<Rational, 3>, 3> m;
  for (int i = 0; i < 3; ++i) {
    m[i] = {Rational(p[i + 1]->x) - Rational(p[0]->x), Rational(p[i + 1]->y) - Rational(p[0]->y),
            Rational(p[i + 1]->z) - Rational(p[0]->z)};
  }
  const Rational det = m[2][0] * (m[0][1] * m[1][2] - m[0][2] * m[1][1]) +
                       m[2][1] * (m[0][2] * m[1][0] - m[0][0] * m[1][2]) +
                       m[2][2] * (m[0][0] * m[1][1] - m[0][1] * m[1][0]);
  return det > 0;
}

/// In the units of the input the differences are rounded, which the bound of the filter allows for (Shewchuk 1997,
/// o3derrboundA).
bool is_positive(const std::vector<Point3>& world, const Tetrahedron& t) {
  const Point3 &a = world[t[0]], u = world[t[1]] - a, v = world[t[2]] - a, w = world[t[3]] - a;
  const double det = w.x * (u.y * v.z - u.z * v.y) + w.y * (u.z * v.x - u.x * v.z) + w.z * (u.x * v.y - u.y * v.x);
  const double permanent = std::fabs(w.x) * (std::fabs(u.y * v.z) + std::fabs(u.z * v.y)) +
                           std::fabs(w.y) * (std::fabs(u.z * v.x) + std::fabs(u.x * v.z)) +
                           std::fabs(w.z) * (std::fabs(u.x * v.y) + std::fabs(u.y * v.x));
  constexpr double factor = 8 * 0x1p-53 * (1 + 1e-6);
  if (std::fabs(det) > factor * permanent) return det > 0;
  return is_positive_exactly({&world[t[0]], &world[t[1]], &world[t[2]], &world[t[3]]});
}

[[noreturn]] void refuse_rounding(const plc::Plc& plc, const std::vector<Point3>& world, const Tetrahedron& t) {
  Place place;
  place.file = plc.name;
  for (const std::uint32_t v : t) place.points.push_back(as_array(world[v]));
  throw MeshError("a tetrahedron is so thin that the rounding of its coordinates inverts it", place,
                  "move the part near to the origin, where coordinates are finer");
}

}  // namespace

std::vector<Point3> to_world(const plc::Plc& plc, std::span<const Point3> points,
                             std::span<const Tetrahedron> tetrahedra) {
  std::vector<Point3> world(points.size());
  for (std::size_t v = 0; v < world.size(); ++v)
    world[v] = v < plc.world.size() && points[v] == plc.vertices[v] ? plc.world[v] : plc.grid.to_world(points[v]);
  // A vertex that goes back to the grid may invert a tetrahedron of another: look again until all are right. All
  // inverted ones are found before any vertex moves, so that their order does not matter.
  std::vector<bool> on_grid(plc.world.size(), false);
  while (true) {
    std::vector<Tetrahedron> inverted;
    for (const Tetrahedron& t : tetrahedra)
      if (!is_positive(world, t)) inverted.push_back(t);
    if (inverted.empty()) return world;
    bool moved = false;
    for (const Tetrahedron& t : inverted) {
      for (const std::uint32_t v : t) {
        if (v >= on_grid.size() || on_grid[v]) continue;
        on_grid[v] = moved = true;
        world[v] = plc.grid.to_world(points[v]);
      }
    }
    if (!moved) refuse_rounding(plc, world, inverted.front());
  }
}

}  // namespace ccdt::mesh
