#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/progress.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/locate/options.h"
#include "engine/plc/plc.h"

namespace ccdt {

/// What the front knows of one of its faces.
struct FrontFace {
  RegionId region;                   ///< the part of the domain above it
  std::uint32_t code = no_neighbor;  ///< its code in the Delaunay cell above it; `no_neighbor` if it is undelaunay
};

/// What the front has built, and where it stopped.
struct FrontResult {
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< positively oriented
  std::vector<RegionId> regions;                         ///< of each tetrahedron
  std::vector<FrontFace> open;  ///< the Delaunay faces above which the domain is left to the labelling
  /// Undelaunay faces that have been in the front: those of the PLC (by their sides within the domain) and new ones.
  std::uint64_t undelaunay_faces = 0;
  /// The front found no vertex for a face, or met itself: the vertices have no constrained Delaunay tetrahedralization,
  /// because a facet that is flat only within the tolerance bends away from a line of sight. The rest is incomplete.
  std::optional<MeshError> stuck = {};
};

/// Who finds the vertices and the faces in their way.
struct FrontLocator {
  LocatorKind kind = LocatorKind::grid;
  double grid_scale = 1;  ///< of the grid: factor of the paper's cell size
};

/// Advances the front of constrained Delaunay tetrahedra from the undelaunay faces until all faces of the front are
/// Delaunay (paper, sections 5.1 to 5.3). For the active face it finds the vertex above it that is visible from it and
/// whose sphere holds no visible vertex. Visibility is from one generic point of the face, which decides it for all: a
/// vertex above a face of the constrained Delaunay tetrahedralization that is in the sphere of the cell there is hidden
/// from every point of the face (Shewchuk 2008).
///
/// \param codes  of `find_delaunay_faces`; all `no_neighbor` to send every face through the front and check none
/// \param face_protection  are new faces looked up in the tetrahedralization?
FrontResult advance_front(const Plc& plc, const FacetMesh& facets, const std::vector<std::uint32_t>& codes,
                          bool face_protection, const Delaunay& delaunay, const FrontLocator& locator = {},
                          const Progress& progress = {});

}  // namespace ccdt
