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
  Measure r;                  ///< see `shape_measure`
  Measure aspect_ratio;       ///< see `aspect_ratio`
  Measure radius_edge_ratio;  ///< see `radius_edge_ratio`
  struct Dihedral {
    double min = 0, max = 0;
    Histogram histogram;  ///< of all six angles of every tetrahedron
  } dihedral_degrees;
  double volume = 0;  ///< of the whole mesh, units of the input cubed
};

/// The paper's measure (section 5): r = ((1/6) sum S_i^2)^(3/2) / (8.48528 V) for edges S_i and volume V. 1 for the
/// regular tetrahedron, infinite for a flat one.
double shape_measure(const std::array<Point3, 4>& tetrahedron);

/// The longest edge over 2 sqrt(6) times the radius of the inscribed sphere: the aspect ratio of VTK and Verdict
/// (Stimpson et al. 2007), and 1 over the measure that HXT improves (Marot and Remacle 2020). 1 for the regular
/// tetrahedron, infinite for a flat one.
double aspect_ratio(const std::array<Point3, 4>& tetrahedron);

/// The radius of the circumscribed sphere over the shortest edge, as TetGen bounds and prints it. 0.612 for the regular
/// tetrahedron, infinite for a flat one. It does not see slivers.
double radius_edge_ratio(const std::array<Point3, 4>& tetrahedron);

/// The angles in degrees between the faces at the edges 01, 02, 03, 12, 13, 23.
std::array<double, 6> dihedral_angles(const std::array<Point3, 4>& tetrahedron);

/// Measures every tetrahedron. All zero for a mesh without any.
Quality measure_quality(const mesh::TetMesh& mesh);

}  // namespace ccdt::bench
