#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/tet_mesh.h"

namespace ccdt {

/// How often a measure falls between `edges[i]` and `edges[i + 1]`; what is outside is counted at the nearer end.
struct Histogram {
  std::vector<double> edges;
  std::vector<std::uint64_t> counts;
};

struct Quality {
  /// The paper's measure (section 5): 1 for the regular tetrahedron, without bound as it degrades.
  struct Shape {
    double min = 0, mean = 0, median = 0, p99 = 0, max = 0;
    Histogram histogram;
  } r;
  struct Dihedral {
    double min = 0, max = 0;
    Histogram histogram;  ///< of all six angles of every tetrahedron
  } dihedral_degrees;
  double volume = 0;  ///< of the whole mesh, units of the input cubed
};

/// r = ((1/6) sum S_i^2)^(3/2) / (8.48528 V) for edges S_i and volume V; infinite for a flat tetrahedron.
double shape_measure(const std::array<Point3, 4>& tetrahedron);

/// The angles in degrees between the faces at the edges 01, 02, 03, 12, 13, 23.
std::array<double, 6> dihedral_angles(const std::array<Point3, 4>& tetrahedron);

/// Measures every tetrahedron. All zero for a mesh without any.
Quality measure_quality(const TetMesh& mesh);

}  // namespace ccdt
