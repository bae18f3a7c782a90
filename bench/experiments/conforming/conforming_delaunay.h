#pragma once

#include <cstdint>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/plc/plc.h"
#include "engine/protection/options.h"
#include "engine/protection/protect_edges.h"

namespace ccdt::conforming {

/// A conforming Delaunay tetrahedralization of a PLC, in which every segment is a chain of Delaunay edges and every
/// facet a union of Delaunay faces; or the state in which the search gave up.
struct ConformingDelaunay {
  bool is_conforming = false;          ///< false: a limit was reached
  std::uint64_t missing_segments = 0;  ///< without further vertices
  std::uint64_t missing_faces = 0;     ///< without further vertices
  std::uint64_t on_segments = 0;       ///< Steiner vertices inside segments
  std::uint64_t in_facets = 0;         ///< Steiner vertices inside facets
  protection::ProtectedDelaunay surface = {};
  facets::FacetMesh faces = {};  ///< of the facets

  std::uint64_t steiner_vertices() const { return on_segments + in_facets; }
};

/// Adds vertices to segments and facets until the tetrahedralization contains both (Ruppert 1995 and Shewchuk 1998,
/// without their rules for the shapes of tetrahedra). A missing segment is split as `protect_edges` splits the
/// grazeable ones. A missing face gets a vertex at its circumcenter; if that is beyond a subsegment of the facet, or in
/// the diametral sphere of one, the subsegment is split instead. Nothing that is already there gets a vertex. This
/// favors the rival, because empty diametral spheres would take more vertices.
///
/// In each round, the faces with the largest circumcircles come first, and those near a new vertex have to wait. Near
/// small angles between facets this may go on forever, so there are limits.
///
/// \param strategy       where segments are split
/// \param most_vertices  the search gives up when there are more
/// \throw MeshError  the vertices are in one plane
ConformingDelaunay make_conforming(plc::Plc plc, protection::Protection strategy, std::size_t most_vertices);

}  // namespace ccdt::conforming
