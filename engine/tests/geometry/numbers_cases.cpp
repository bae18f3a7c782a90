#include "engine/tests/geometry/numbers_cases.h"

#include <algorithm>
#include <utility>

namespace ccdt::test {
namespace {

using Vector = std::array<std::int64_t, 3>;

Point3 as_point(const Vector& v) {
  const auto inside = [](std::int64_t x) {
    return static_cast<double>(std::clamp(x, -largest_coordinate, largest_coordinate));
  };
  return {inside(v[0]), inside(v[1]), inside(v[2])};
}

Vector draw_vector(Random& random, std::int64_t largest) {
  return {draw_between(random, -largest, largest), draw_between(random, -largest, largest),
          draw_between(random, -largest, largest)};
}

std::int64_t draw_power(Random& random, int largest_exponent) {
  return std::int64_t{1} << draw_between(random, 0, largest_exponent);
}

Vector combine(const Vector& o, std::int64_t s, const Vector& u, std::int64_t t, const Vector& v) {
  return {o[0] + s * u[0] + t * v[0], o[1] + s * u[1] + t * v[1], o[2] + s * u[2] + t * v[2]};
}

template <class Draw>
std::array<Point3, 6> six(const Draw& draw) {
  std::array<Point3, 6> points;
  for (Point3& p : points) p = as_point(draw());
  return points;
}

std::array<Point3, 6> draw_box(Random& random) {
  const Vector corner = draw_vector(random, largest_coordinate / 2);
  const Vector size = {draw_power(random, 50), draw_power(random, 50), draw_power(random, 50)};
  return six([&]() -> Vector {
    return {corner[0] + draw_between(random, 0, size[0]), corner[1] + draw_between(random, 0, size[1]),
            corner[2] + draw_between(random, 0, size[2])};
  });
}

std::array<Point3, 6> draw_extremes(Random& random) {
  const auto one = [&]() -> std::int64_t {
    const std::int64_t magnitude = largest_coordinate - draw_between(random, 0, 1) * draw_power(random, 21);
    return draw_between(random, 0, 6) == 0 ? draw_between(random, -1, 1) : random() % 2 ? magnitude : -magnitude;
  };
  return six([&]() -> Vector { return {one(), one(), one()}; });
}

std::array<Point3, 6> draw_lattice(Random& random) {
  const std::int64_t step = draw_power(random, 46), most = draw_between(random, 1, 8);
  const Vector o = draw_vector(random, largest_coordinate / 2);
  return six([&] { return combine(o, step, draw_vector(random, most), 0, {}); });
}

std::array<Point3, 6> draw_plane(Random& random) {
  const std::int64_t size = draw_power(random, 45);
  const Vector o = draw_vector(random, largest_coordinate / 2), u = draw_vector(random, size),
               v = draw_vector(random, size);
  return six([&] { return combine(o, draw_between(random, -4, 4), u, draw_between(random, -4, 4), v); });
}

std::array<Point3, 6> draw_segments(Random& random) {
  const std::int64_t size = draw_power(random, 29);
  const Vector o = draw_vector(random, largest_coordinate / 2), u = draw_vector(random, size),
               v = draw_vector(random, size);
  // The segments meet in o; as the ends differ by multiples of the quantum, fractions of 2^-20 are on the grid.
  return six([&] {
    const std::int64_t fraction = draw_between(random, 0, 1 << 20);
    return random() % 2 ? combine(o, fraction, u, 0, v) : combine(o, 0, u, fraction, v);
  });
}

std::array<Point3, 6> draw_sphere(Random& random) {
  const Vector center = draw_vector(random, largest_coordinate / 2),
               radius = draw_vector(random, draw_power(random, 49));
  return six([&] {
    Vector v = radius;
    for (int i = 2; i > 0; --i) std::swap(v[i], v[draw_between(random, 0, i)]);
    for (std::int64_t& x : v) x = random() % 2 ? x : -x;
    return combine(center, 1, v, 0, v);
  });
}

std::array<Point3, 6> draw_unmoved(Random& random, Family family) {
  switch (family) {
    case Family::anywhere:
      return six([&] { return draw_vector(random, largest_coordinate); });
    case Family::box_of_any_size:
      return draw_box(random);
    case Family::extremes:
      return draw_extremes(random);
    case Family::lattice:
      return draw_lattice(random);
    case Family::plane:
      return draw_plane(random);
    case Family::segments:
      return draw_segments(random);
    case Family::sphere:
      return draw_sphere(random);
  }
  return {};
}

}  // namespace

std::array<Point3, 6> draw_points(Random& random, Family family) {
  std::array<Point3, 6> points = draw_unmoved(random, family);
  if (random() % 2) {
    // Toward zero, so that the point stays on the grid.
    Point3& p = points[random() % 6];
    double& x = random() % 3 == 0 ? p.x : random() % 2 ? p.y : p.z;
    const double by = random() % 2 ? 1 : 1048576;
    x += x > 0 ? -by : by;
  }
  return points;
}

}  // namespace ccdt::test
