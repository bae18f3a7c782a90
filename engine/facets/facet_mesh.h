#pragma once

#include <array>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/progress.h"
#include "engine/delaunay/delaunay.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::facets {

/// The faces that the mesh must contain.
struct FacetMesh {
  std::vector<std::array<VertexId, 3>> triangles;  ///< counterclockwise seen from above their facet
  std::vector<FacetId> facet;                      ///< of each triangle
};

/// Triangulates every facet with all its vertices, Steiner vertices included: its constrained Delaunay triangulation,
/// which contains every Delaunay face in the facet.
///
/// Where vertices of a nearly flat facet are cocircular or on the convex hull, there are tetrahedra with all vertices
/// in the facet and almost no volume. Their two sides are two triangulations of the same patch. The facet takes the one
/// on the side of the domain, so that the flat tetrahedra stay outside; if the domain is on both sides, it takes the
/// upper one.
FacetMesh triangulate_facets(const plc::Plc& plc, const protection::SegmentChains& chains,
                             const delaunay::Delaunay& delaunay, const Progress& progress = {});

/// Updates the triangulation after interior vertices were added to the tetrahedralization. An exactly flat facet stays
/// as it is: its triangulation depends only on its own vertices. A nearly flat facet is triangulated again, unless all
/// its triangles are Delaunay and face the domain.
///
/// \param codes  for every triangle, its code in the cell above it; `no_neighbor` if it is not a Delaunay face
/// \return       has any triangle changed?
bool follow_interior_vertices(const plc::Plc& plc, const protection::SegmentChains& chains,
                              const delaunay::Delaunay& delaunay, const std::vector<std::uint32_t>& codes,
                              FacetMesh& facets);

}  // namespace ccdt::facets
