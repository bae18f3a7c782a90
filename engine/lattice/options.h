#pragma once

#include <array>

#include "engine/base/enum_names.h"

namespace ccdt::sizes {
struct WantedSizes;
}

namespace ccdt::lattice {

/// The points that fill the inside: those of a crystal lattice, or circumcenters.
enum class Lattice {
  none,
  fcc,
  bcc,
  sc,
  refinement  ///< no lattice, but Delaunay refinement: circumcenters of skinny and of large tetrahedra
};

constexpr auto names_of(Lattice) {
  return std::to_array<NamedValue<Lattice>>({{Lattice::fcc, "fcc", "face-centered cubic"},
                                             {Lattice::bcc, "bcc", "body-centered cubic"},
                                             {Lattice::sc, "sc", "simple cubic"},
                                             {Lattice::none, "none", "no interior points"},
                                             {Lattice::refinement, "refinement",
                                              "no lattice: circumcenters of skinny and of large tetrahedra "
                                              "(Delaunay refinement)"}});
}

/// Lattice points nearer the surface than this times the lattice's edge length are dropped. See the table in
/// clear_sites.cpp.
inline constexpr double usual_clearance = 0.55;

struct LatticeOptions {
  Lattice kind = Lattice::fcc;
  double edge_length = 0;  ///< target edge length in grid units; 0: that of the surface
  double grading = 0.5;    ///< growth of the edge length per unit of distance from the surface; 0: uniform
  /// Factor for the radii of the smallest spheres around surface triangles and subsegments, which may contain no point;
  /// 1 is the paper's rule, 0 switches it off.
  double sphere_factor = 1;
  double clearance = usual_clearance;          ///< least distance to the surface, in edge lengths of the lattice there
  double radius_edge = 2;                      ///< Delaunay refinement: the largest circumradius over the shortest edge
  double surface_factor = 1;                   ///< of the edge lengths of the surface, where these are the target
  double most_tetrahedra = 0;                  ///< refuse to place points for many more; 0: any number
  const sizes::WantedSizes* wanted = nullptr;  ///< null or empty: no more than that
};

}  // namespace ccdt::lattice
