#include "engine/tests/delaunay/delaunay_point_sets.h"

#include <algorithm>
#include <random>
#include <utility>

namespace ccdt::test {
namespace {

using Random = std::mt19937_64;

double draw(Random& random, int n) {
  return static_cast<double>(random() % static_cast<std::uint64_t>(n));
}

bool before(const Point3& a, const Point3& b) {
  return as_array(a) < as_array(b);
}

/// Without duplicates, in an order independent of the positions.
std::vector<Point3> distinct(std::vector<Point3> points, std::uint64_t seed) {
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return shuffled(std::move(points), seed);
}

/// The points of the half-integer grid of n^3 unit cells that are in a lattice.
template <class Contains>
std::vector<Point3> lattice(int n, double step, const Contains& contains) {
  std::vector<Point3> points;
  for (int x = 0; x <= 2 * n; ++x)
    for (int y = 0; y <= 2 * n; ++y)
      for (int z = 0; z <= 2 * n; ++z)
        if (contains(x, y, z)) points.push_back({x * step / 2, y * step / 2, z * step / 2});
  return shuffled(std::move(points), 1);
}

std::vector<Point3> first(std::vector<Point3> points, std::size_t n) {
  points.resize(std::min(n, points.size()));
  return points;
}

}  // namespace

std::vector<Point3> shuffled(std::vector<Point3> points, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random() % i]);
  return points;
}

std::vector<Point3> random_points(int n, std::uint64_t seed) {
  Random random(seed);
  const auto coordinate = [&] { return static_cast<double>(random() >> 12) - 0x1p51; };
  std::vector<Point3> points(n);
  for (Point3& p : points) p = {coordinate(), coordinate(), coordinate()};
  return points;
}

std::vector<Point3> simple_cubic(int n, double step) {
  return lattice(n, step, [](int x, int y, int z) { return x % 2 == 0 && y % 2 == 0 && z % 2 == 0; });
}

std::vector<Point3> body_centered(int n, double step) {
  return lattice(n, step, [](int x, int y, int z) { return x % 2 == y % 2 && y % 2 == z % 2; });
}

std::vector<Point3> face_centered(int n, double step) {
  return lattice(n, step, [](int x, int y, int z) { return (x + y + z) % 2 == 0; });
}

std::vector<Point3> points_on_sphere(std::size_t n, const Point3& center) {
  for (int square = 1;; ++square) {
    std::vector<Point3> points;
    int side = 0;
    while ((side + 1) * (side + 1) <= square) ++side;
    for (int x = -side; x <= side; ++x)
      for (int y = -side; y <= side; ++y)
        for (int z = -side; z <= side; ++z)
          if (x * x + y * y + z * z == square) points.push_back(center + Point3{double(x), double(y), double(z)});
    if (points.size() >= n) return shuffled(std::move(points), 2);
  }
}

std::vector<Point3> points_on_box(int n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point3> points;
  for (int i = 0; i < n; ++i) {
    const int side = i % 2 ? 8 : 1 << 20;  // every other point on a coarse grid
    const double step = (1 << 20) / side;
    std::array<double, 3> p;
    for (double& x : p) x = draw(random, side + 1) * step;
    if (i % 8 != 0) p[random() % 3] = random() % 2 ? 0 : 1 << 20;
    points.push_back({p[0], p[1], p[2]});
  }
  return distinct(std::move(points), seed);
}

std::vector<Point3> points_on_lines(int n, std::uint64_t seed) {
  Random random(seed);
  const Point3 directions[] = {{1024, 0, 0}, {512, 1024, 256}, {-3, 5, 1021}};
  std::vector<Point3> points = {{}, {1, 1000, 10000}};
  for (int i = 0; i < n; ++i) points.push_back((draw(random, 2001) - 1000) * directions[i % 3]);
  return distinct(std::move(points), seed);
}

std::vector<Point3> plane_and_apex(int n) {
  std::vector<Point3> plane;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y) plane.push_back({double(x), double(y), 0});
  std::vector<Point3> points = shuffled(std::move(plane), 3);
  points.insert(points.begin(), {3, 2, 7});
  return points;
}

std::vector<Point3> two_circles() {
  std::vector<Point3> points;
  for (const double z : {0.0, 40.0})
    for (int x = -25; x <= 25; ++x)
      for (int y = -25; y <= 25; ++y)
        if (x * x + y * y == 625) points.push_back({double(x), double(y), z});
  return shuffled(std::move(points), 4);
}

std::vector<NamedPoints> tiny_sets() {
  return {
      {"four points", {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
      {"random", random_points(30, 1)},
      {"cube", simple_cubic(1)},
      {"simple cubic lattice", simple_cubic(2)},
      {"body-centered lattice", first(body_centered(2), 35)},
      {"face-centered lattice", first(face_centered(2), 35)},
      {"face-centered unit cell", face_centered(1)},
      {"sphere", points_on_sphere(24)},
      {"box", first(points_on_box(60, 5), 32)},
      {"lines", first(points_on_lines(60, 6), 28)},
      {"plane and apex", plane_and_apex(5)},
      {"two circles", first(two_circles(), 32)},
  };
}

std::vector<NamedPoints> small_sets() {
  auto sphere_and_center = points_on_sphere(200);
  sphere_and_center.push_back({});
  return {
      {"random", random_points(400, 11)},
      {"simple cubic lattice", simple_cubic(6)},
      {"body-centered lattice", body_centered(5)},
      {"face-centered lattice", face_centered(4)},
      {"face-centered lattice of large steps", face_centered(4, 0x1p48)},
      {"sphere", points_on_sphere(200)},
      {"sphere and center", shuffled(std::move(sphere_and_center), 8)},
      {"sphere far from the origin", points_on_sphere(150, {0x1p51 - 100, 0x1p50, -0x1p51 + 100})},
      {"box", points_on_box(500, 12)},
      {"lines", points_on_lines(250, 13)},
      {"plane and apex", plane_and_apex(18)},
      {"two circles", two_circles()},
  };
}

}  // namespace ccdt::test
