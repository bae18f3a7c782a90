#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/point.h"

/// The points that the benchmarks run on, in grid units (engine/numbers/grid.h); the same on every machine.
namespace ccdt::benchmarks {

/// Uniformly distributed in a cube, snapped to the quantum as the vertices of an input are.
std::vector<Point3> random_points(std::size_t n, std::uint64_t seed);

/// The first n points of a perfect face-centered lattice in a cube, layer by layer, put in random order.
std::vector<Point3> lattice_points(std::size_t n, std::uint64_t seed);

}  // namespace ccdt::benchmarks
