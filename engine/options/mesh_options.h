#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/flatness.h"
#include "engine/base/progress.h"
#include "engine/base/stages.h"
#include "engine/delaunay/options.h"
#include "engine/front/options.h"
#include "engine/front/segment_counts.h"
#include "engine/improve/counts.h"
#include "engine/improve/options.h"
#include "engine/lattice/options.h"
#include "engine/locate/options.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/input.h"
#include "engine/plc/periodicity.h"
#include "engine/protection/options.h"
#include "engine/sizes/background_sizes.h"
#include "engine/sizes/local_sizes.h"
#include "engine/surface/options.h"

namespace ccdt {

// The names that a user of the engine needs, each from its stage.
using delaunay::DelaunayMethod;
using front::SegmentCounts;
using front::Visibility;
using improve::BoundaryRule;
using improve::ImproveCounts;
using improve::Improvement;
using improve::ImproveOptions;
using improve::ImproveStop;
using improve::SteinerRule;
using lattice::Lattice;
using locate::LocatorKind;
using mesh::TetMesh;
using plc::InputPlc;
using plc::Periodicity;
using plc::PolygonFacet;
using protection::Protection;
using sizes::BackgroundSizes;
using sizes::LocalSize;
using sizes::LocalSizes;
using sizes::SizeFunction;
using surface::SurfaceRule;
using tets::Objective;

/// The strategies of the engine and their parameters.
struct MeshOptions {
  bool face_protection = true;  ///< check which faces are Delaunay first; off: every face goes through the front
  Lattice lattice = Lattice::fcc;
  Protection protection = Protection::shell;
  LocatorKind locator = LocatorKind::cavity;
  DelaunayMethod delaunay = DelaunayMethod::core;
  Visibility visibility = Visibility::centroid;
  double least_core = 0.35;  ///< `core` inserts all points if a smaller share of the lattice than this is deep within
                             ///< one level, because searching for cores would then take longer; 0: always search
  double grid_scale = 1;     ///< factor of the cell size of the paper's uniform grids (section 4)
  SurfaceRule surface = SurfaceRule::keep;
  double sharp_angle = surface::usual_sharp_angle;  ///< see RemeshOptions
  double deviation = 0;                             ///< see RemeshOptions
  double thin_tetrahedra = 2e6;                     ///< about how many thin places of a refined surface may cause
  double edge_length = 0;  ///< target edge length in the units of the input; 0: that of the surface or, if that
                           ///< is refined, a fortieth of the diagonal of the bounding box. `remesh` needs one
  double grading = 0.5;    ///< growth of the edge length per unit of distance from the surface; 0: uniform
  double flatness = usual_flatness;             ///< see PlcOptions
  double sphere_factor = 1;                     ///< see LatticeOptions
  double clearance = lattice::usual_clearance;  ///< see LatticeOptions
  double radius_edge = 2;                       ///< see LatticeOptions
  unsigned threads = 0;                         ///< how many work at the same time; 0: one per core. Same mesh.
  ImproveOptions improve = {};                  ///< improvement of the finished mesh; see `improvement_of`
  /// A size function, in the units of the input. For the inside, it replaces the edge lengths of the surface.
  BackgroundSizes background = {};
  LocalSizes local = {};      ///< where edges should be shorter; needs a grading
  double surface_factor = 1;  ///< of the edge lengths of the surface, where these are the target for the inside
  Periodicity periodic = Periodicity::none;  ///< opposite sides of the box of the input, which must be equal, get the
                                             ///< same vertices and triangles; not with a new surface
  double tetrahedra = 0;       ///< scale all sizes until the mesh has this many, within five percent; 0: do not
  double most_tetrahedra = 0;  ///< refuse to make more, if possible before they are made; 0: any number
};

/// What remeshing gets of the options, which must live as long.
inline surface::RemeshOptions remesh_options_of(const MeshOptions& options) {
  return {.edge_length = options.edge_length,
          .sharp_angle = options.sharp_angle,
          .flatness = options.flatness,
          .deviation = options.deviation,
          .local = &options.local,
          .background = &options.background,
          .most_tetrahedra = options.most_tetrahedra,
          .usual_factor = options.surface_factor};
}

struct MeshCounts {
  std::uint64_t vertices = 0;           ///< of the mesh
  std::uint64_t steiner_vertices = 0;   ///< added on segments and facets
  std::uint64_t interior_vertices = 0;  ///< lattice points, after improvement
  std::uint64_t tetrahedra = 0;
  std::uint64_t faces = 0;             ///< triangles on facets
  std::uint64_t undelaunay_faces = 0;  ///< of those, the ones that are not Delaunay
  std::uint64_t front_tetrahedra = 0;  ///< tetrahedra built by the front
  /// Steiner vertices on segments, by level from 1: one more than the number of splits that led to the piece they
  /// split.
  std::vector<std::uint64_t> splits_by_level = {};
  std::uint64_t dropped_interior_vertices = 0;  ///< lattice points that could have destroyed a protected edge
  std::uint64_t core_tetrahedra = 0;            ///< of the Delaunay tetrahedra, those of lattice cores (`core` only)
  std::uint64_t front_faces = 0;  ///< undelaunay faces that the front has met, its own included (paper, section 5.3)
  std::uint64_t refined_on_segments = 0;       ///< vertices that refinement added to segments
  std::uint64_t refined_in_facets = 0;         ///< and to facets
  std::optional<SegmentCounts> segments = {};  ///< only from ccdt
  ImproveCounts improve = {};
};

/// The improvement with these options: the given one or, by default, everything. But the default is nothing if the
/// lattice is `none`, because the result is then a mesh of the surface alone: with `SteinerRule::keep`, the constrained
/// Delaunay tetrahedralization of the input.
Improvement improvement_of(const MeshOptions& options);

}  // namespace ccdt
