#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "engine/geometry/grid.h"

/// The points that the benchmarks run on, in grid units (engine/geometry/grid.h); the same on every machine.
namespace ccdt::benchmarks {

/// Uniformly distributed in a cube, snapped to the quantum as the vertices of an input are.
inline std::vector<Point3> random_points(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto coordinate = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<Point3> points(n);
  for (Point3& p : points) p = {coordinate(), coordinate(), coordinate()};
  const DyadicGrid grid = make_grid(points);
  for (Point3& p : points) p = grid.snap(p);
  return points;
}

/// The first n points of a perfect face-centered lattice in a cube, layer by layer, put in random order.
inline std::vector<Point3> lattice_points(std::size_t n, std::uint64_t seed) {
  // Half of the points of a simple cubic lattice, those with an even sum.
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(2.0 * static_cast<double>(n)))) + 1;
  const double step = std::exp2(std::floor(51 - std::log2(static_cast<double>(side))));
  std::vector<Point3> points;
  points.reserve(n + side * side);
  for (std::size_t z = 0; points.size() < n; ++z)
    for (std::size_t y = 0; y < side; ++y)
      for (std::size_t x = (y + z) % 2; x < side; x += 2)
        points.push_back(step * Point3{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
  points.resize(n);
  // Not std::shuffle, whose result depends on the library.
  std::mt19937_64 random(seed);
  for (std::size_t i = n; i > 1; --i) std::swap(points[i - 1], points[random() % i]);
  return points;
}

}  // namespace ccdt::benchmarks
