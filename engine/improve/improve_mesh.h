#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/raw_vector.h"
#include "engine/improve/counts.h"
#include "engine/improve/options.h"
#include "engine/improve/smoothing.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"
#include "engine/tets/cell_complex.h"

namespace ccdt::improve {

/// The goals of the options, as numbers to compare with.
QualityGoal goal_of(const ImproveOptions& options);

/// Improves the cells that are not good enough, the worst first: by swaps, by moving vertices, and, where both are
/// stuck, by inserting and removing interior vertices. The worst of the new cells is always better than the worst of
/// the replaced ones, and all are exactly positive. Cells whose surroundings have changed are tried again, until all
/// are good enough, no change helps, or the time is up.
///
/// \param freedom  of the vertices that are not interior; empty: they stay
ImproveCounts improve_cells(tets::CellComplex& complex, const std::vector<Freedom>& freedom,
                            const ImproveOptions& options, const Progress& progress = {});

/// The data of a mesh that `improve_mesh` needs.
struct ImproveInput {
  const plc::Plc& plc;
  protection::SegmentChains& chains;         ///< lose the Steiner vertices that are removed
  LargeVector<tets::Cell> cells;             ///< the mesh's tetrahedra; neighbors may be missing
  std::vector<std::uint32_t> facet_of_face;  ///< of each of the mesh's faces
  std::size_t first_steiner;                 ///< the least Steiner vertex
  std::size_t first_interior;                ///< the least interior vertex
  /// The least vertex that was put inside a segment or a facet and may slide there regardless of the options.
  std::size_t first_sliding = std::numeric_limits<std::size_t>::max();
};

/// Removes Steiner vertices from a whole mesh (`SteinerRule`), then improves it (paper, section 5: edge-face swaps and
/// smoothing), and divides tetrahedra that are larger than their region allows. Its boundary, segments, facets and
/// input vertices stay where they are, except for what `BoundaryRule::slide` and `first_sliding` let move on them.
///
/// \param points  the vertices in grid units: those of the PLC, Steiner vertices, and interior ones
/// \param mesh    without coordinates
ImproveCounts improve_mesh(ImproveInput input, const ImproveOptions& options, std::vector<Point3>& points,
                           mesh::TetMesh& mesh, const Progress& progress = {});

}  // namespace ccdt::improve
