#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/progress.h"
#include "engine/facets/facet_mesh.h"
#include "engine/improve/counts.h"
#include "engine/improve/options.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt {

/// Improves a whole mesh (paper, section 5: edge-face swaps and smoothing). Its boundary, segments and facets stay what
/// they are, with the vertices of the input where they are; `BoundaryRule::slide` says what may move on them.
///
/// \param facet_of_face  the facet of each of the mesh's faces
/// \param points         the vertices in grid units: those of the PLC, Steiner vertices, and interior ones
/// \param mesh           without coordinates
ImproveCounts improve_mesh(const Plc& plc, const SegmentChains& chains, std::vector<std::uint32_t> facet_of_face,
                           std::size_t first_interior, const ImproveOptions& options, std::vector<Point3>& points,
                           TetMesh& mesh, const Progress& progress = {});

}  // namespace ccdt
