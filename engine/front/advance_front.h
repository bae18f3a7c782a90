#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/progress.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/front/options.h"
#include "engine/locate/options.h"
#include "engine/plc/plc.h"

namespace ccdt::front {

using delaunay::cell_of, delaunay::face_of, delaunay::ghost_vertex, delaunay::no_neighbor;

/// The state of one face of the front.
struct FrontFace {
  RegionId region;                   ///< the part of the domain above it
  std::uint32_t code = no_neighbor;  ///< its code in the Delaunay cell above it; `no_neighbor` if it is undelaunay
};

/// The result of the front.
struct FrontResult {
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< positively oriented
  std::vector<RegionId> regions;                         ///< of each tetrahedron
  std::vector<FrontFace> open;  ///< the Delaunay faces above which the domain is left to the labeling
  /// Undelaunay faces that have been in the front: those of the PLC (once per side within the domain) and new ones.
  std::uint64_t undelaunay_faces = 0;
};

/// The input of the front; all of it must outlive the stage.
struct FrontInput {
  const plc::Plc& plc;
  const facets::FacetMesh& facets;
  const std::vector<std::uint32_t>& codes;  ///< of `find_delaunay_faces`; without Delaunay faces, all are `no_neighbor`
  const delaunay::Delaunay& delaunay;
};

struct FrontOptions {
  locate::LocatorKind locator = locate::LocatorKind::grid;
  double grid_scale = 1;        ///< of the grid: factor of the paper's cell size
  bool face_protection = true;  ///< are new faces looked up in the tetrahedralization?
  Visibility visibility = Visibility::centroid;
  /// The `cavity` locator tries all vertices of a chamber with at most this many: fewer than are near a face.
  std::size_t small_chamber = 256;
};

/// Advances the front of constrained Delaunay tetrahedra from the undelaunay faces until all faces of the front are
/// Delaunay (paper, sections 5.1 to 5.3). For the active face it finds the vertex above it that is visible from it and
/// whose sphere holds no visible vertex. Visibility is tested from one generic point of the face, which decides it for
/// all its points: a vertex above a face of the constrained Delaunay tetrahedralization that is in the sphere of the
/// cell there is hidden from every point of the face (Shewchuk 2008). The paper's tests (`Visibility::faces`) come
/// before this one.
///
/// In a large chamber, the `cavity` locator tries vertices near a face first, because the sphere of a needle may
/// contain thousands of hidden ones. If the tetrahedra fit together, they are right; those that do not fit are made
/// again with all vertices tried. The locators of the whole model try all vertices, as in the paper.
///
/// \throw MeshError  the front found no vertex for a face, or met itself: the surface was not protected
FrontResult advance_front(const FrontInput& input, const FrontOptions& options = {}, const Progress& progress = {});

}  // namespace ccdt::front
