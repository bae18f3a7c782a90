#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <vector>

#include "engine/mesh/tet_mesh.h"

namespace ccdt::bench {

/// The number of values between `edges[i]` and `edges[i + 1]`; values outside count at the nearer end.
struct Histogram {
  std::vector<double> edges;
  std::vector<std::uint64_t> counts;
};

/// The degrees of one radian.
inline constexpr double degrees = 180 / std::numbers::pi;

struct Quality {
  /// A measure of all tetrahedra: smaller is better, and it grows without bound as a tetrahedron degenerates.
  struct Measure {
    double min = 0, mean = 0, median = 0, p99 = 0, max = 0;
    Histogram histogram = {};
  };
  Measure r;  ///< see engine/geometry/tetrahedron_shape.h
  Measure aspect_ratio;
  Measure radius_edge_ratio;
  struct Dihedral {
    double min = 0, max = 0;
    Histogram histogram;  ///< of all six angles of every tetrahedron
  } dihedral_degrees;
  double volume = 0;  ///< of the whole mesh, units of the input cubed
};

/// Measures every tetrahedron. All zero for a mesh without any.
Quality measure_quality(const mesh::TetMesh& mesh);

}  // namespace ccdt::bench
