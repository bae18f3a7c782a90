#pragma once

#include <cstdint>

#include "engine/mesh/tet_mesh.h"

namespace ccdt::bench {

/// The share of bad tetrahedra that bad triangles of the surface cause. Improving the inside cannot repair these.
struct SurfaceLimit {
  static constexpr double bad_r = 3;       ///< a tetrahedron is bad if it is worse (`shape_measure`)
  static constexpr double bad_angle = 18;  ///< a triangle is bad if it has a smaller angle, in degrees

  std::uint64_t bad_tetrahedra = 0;
  std::uint64_t at_bad_triangles = 0;  ///< of these, the ones with two corners or more of one bad triangle
  double least_angle = 180;            ///< of all triangles, in degrees

  /// Are most bad tetrahedra at bad triangles?
  bool limits_quality() const { return at_bad_triangles > 0 && 2 * at_bad_triangles >= bad_tetrahedra; }
};

SurfaceLimit find_surface_limit(const mesh::TetMesh& mesh);

}  // namespace ccdt::bench
