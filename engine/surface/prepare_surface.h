#pragma once

#include <cstddef>
#include <optional>

#include "engine/base/progress.h"
#include "engine/base/stages.h"
#include "engine/plc/input.h"
#include "engine/surface/options.h"

namespace ccdt::surface {

/// The surface that bounds a mesh.
struct PreparedSurface {
  std::optional<plc::InputPlc> changed = {};  ///< in place of the input; none: the input serves as it is
  std::size_t facets = 0;                     ///< before remeshing, with the triangles of bent polygons
  double edge_length = 0;                     ///< the target for meshing
  StageCosts costs = {};                      ///< of `Stage::plc` and `Stage::remesh`
};

/// Makes of an input what the rule asks for before a PLC is built: triangulates the polygons that are not planar
/// (`plc::triangulate_bent_facets`), bounds the edge length and remeshes.
///
/// \param options  A length beyond the diagonal of the bounding box becomes that diagonal: it would only make the
///                 octree of the lattice too large. Length 0: with `SurfaceRule::refine` a fortieth of the diagonal
/// \throw InputError, MeshError  as `plc::triangulate_bent_facets` and `remesh_surface`
/// \throw LimitError             a new surface would have too many vertices
PreparedSurface prepare_surface(const plc::InputPlc& input, SurfaceRule rule, RemeshOptions options,
                                const Progress& progress = {});

}  // namespace ccdt::surface
