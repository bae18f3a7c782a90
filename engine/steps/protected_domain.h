#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/raw_vector.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::steps {

/// A Delaunay tetrahedralization of all vertices, for which a constrained one exists.
struct ProtectedDomain {
  plc::Plc plc;
  protection::SegmentChains chains;
  delaunay::Delaunay delaunay;
  facets::FacetMesh facets;
  std::vector<std::uint32_t> codes;  ///< of the faces of the facets, see `front::FrontInput`
  std::size_t first_interior = 0;    ///< of its vertices
};

/// The constrained Delaunay tetrahedralization of an input as a mesh.
struct Tetrahedralization {
  mesh::TetMesh mesh = {};                        ///< without coordinates
  LargeVector<delaunay::Cell> cells = {};         ///< its tetrahedra, partly joined, if they will be improved
  std::vector<Point3> points = {};                ///< of the mesh, in grid units
  std::vector<std::uint32_t> facet_of_face = {};  ///< by face of the mesh
};

}  // namespace ccdt::steps
