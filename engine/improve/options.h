#pragma once

#include <array>
#include <optional>

#include "engine/base/enum_names.h"
#include "engine/tets/objective.h"

namespace ccdt::improve {

using tets::Objective;

/// What improvement may do.
enum class Improvement {
  none,
  swap,         ///< other tetrahedra of the same vertices: edges and faces are removed
  smooth,       ///< other positions of the same vertices
  swap_smooth,  ///< both, as in the paper (section 5)
  all           ///< both, and insertion and removal of interior vertices where these are stuck
};

constexpr auto names_of(Improvement) {
  return std::to_array<NamedValue<Improvement>>(
      {{Improvement::all, "all", "swaps, smoothing, insertion, collapse and reconnection"},
       {Improvement::swap, "swap", "other tetrahedra of the same vertices"},
       {Improvement::smooth, "smooth", "other positions of the same vertices"},
       {Improvement::swap_smooth, "swap-smooth", "both, as in the paper"},
       {Improvement::none, "none", "the mesh as it is"}});
}

/// What happens to the vertices on the boundary and on interior facets.
enum class BoundaryRule {
  keep,  ///< those of the input stay where they are
  slide  ///< those inside a facet may move in it, those inside a segment along it
};

constexpr auto names_of(BoundaryRule) {
  return std::to_array<NamedValue<BoundaryRule>>(
      {{BoundaryRule::keep, "keep", "vertices of the input stay; those that split segments may move along them"},
       {BoundaryRule::slide, "slide", "vertices inside facets and segments may move along them"}});
}

/// What happens to the Steiner vertices on segments, before improvement.
enum class SteinerRule {
  remove,  ///< those that the mesh can do without are removed; it is then not constrained Delaunay where they were
  keep     ///< all stay
};

constexpr auto names_of(SteinerRule) {
  return std::to_array<NamedValue<SteinerRule>>(
      {{SteinerRule::remove, "remove", "remove those that the mesh can do without"},
       {SteinerRule::keep, "keep", "keep all: without improvement, the mesh is constrained Delaunay"}});
}

struct ImproveOptions {
  std::optional<Improvement> improvement = {};  ///< unset: all, or none if the lattice is none
  Objective objective = Objective::r;
  BoundaryRule boundary = BoundaryRule::keep;
  double target_dihedral = 20;  ///< target: all dihedral angles are between this and 180 minus this, in degrees
  double target_r = 2;          ///< target for every tetrahedron; only for `Objective::r`
  double time = 0;              ///< stop improvement after this many seconds; 0: no limit
  SteinerRule steiner = SteinerRule::remove;  ///< also with `Improvement::none`
};

}  // namespace ccdt::improve
