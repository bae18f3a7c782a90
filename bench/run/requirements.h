#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/mesh/tet_mesh.h"
#include "engine/surface/surface_change.h"

namespace ccdt::bench {

/// What a finished mesh must keep.
struct Requirements {
  std::optional<double> dihedral_degrees;  ///< no angle is below this, or above 180 degrees less this
  std::optional<double> r;                 ///< no r is above this; see `shape_measure`
  std::optional<double> deviation;         ///< of a remeshed surface from the old one, in units of the input

  bool empty() const { return !dihedral_degrees && !r && !deviation; }
};

/// A requirement that a mesh misses.
struct MissedRequirement {
  struct Spot {
    std::array<double, 3> at = {};  ///< the center of a tetrahedron, or a point of a surface, in units of the input
    double value = 0;
  };
  std::string name;              ///< "dihedral_degrees", "r" or "deviation"
  double limit = 0;              ///< what was required
  std::uint64_t count = 0;       ///< of tetrahedra that miss it; 1 for the surface
  std::vector<Spot> worst = {};  ///< at most five, the worst first
};

/// \param change  of a remeshed surface; none: it was not remeshed
std::vector<MissedRequirement> find_missed(const Requirements& required, const mesh::TetMesh& mesh,
                                           const std::optional<surface::SurfaceChange>& change);

/// "3 of 1,200 tetrahedra have a dihedral angle below 10 or above 170 degrees; the worst: 3.21 at (0.5, 1, 2), ..."
std::string words_of(const MissedRequirement& missed, std::uint64_t tetrahedra);

}  // namespace ccdt::bench
