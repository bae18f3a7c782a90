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
  std::optional<plc::InputPlc> changed = {};  ///< in place of the input; none: the input is used as it is
  std::size_t facets = 0;                     ///< before remeshing, with the triangles of warped polygons
  double edge_length = 0;                     ///< the target for meshing
  StageCosts costs = {};                      ///< of `Stage::plc` and `Stage::remesh`
};

/// Does what the rule asks for before a PLC is built: triangulates warped polygons (`plc::triangulate_warped_facets`),
/// bounds the edge length, and remeshes.
///
/// \param options  A length beyond the diagonal of the bounding box becomes that diagonal, since it would only make the
///                 lattice's octree too large. With `SurfaceRule::refine` and `automatic`, and for remeshing with other
///                 sizes, length 0 becomes a fortieth of the diagonal, or the diagonal if all regions have a largest
///                 volume
/// \throw InputError, MeshError  as in `plc::triangulate_warped_facets` and `remesh_surface`
/// \throw LimitError             a new surface would have too many vertices
PreparedSurface prepare_surface(const plc::InputPlc& input, SurfaceRule rule, RemeshOptions options,
                                const Progress& progress = {});

}  // namespace ccdt::surface
