#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/base/point.h"

namespace ccdt::mesh {

/// A tetrahedral mesh, in the units of the input. All arrays are indexed by plain integers; an attribute array has one
/// entry per element.
struct TetMesh {
  std::vector<Point3> vertices;  ///< of the input (merged), then Steiner vertices, then interior vertices
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< positively oriented: ((b-a) x (c-a)) . (d-a) > 0
  std::vector<int> regions;                              ///< region attribute of each tetrahedron
  std::vector<int> partitions;  ///< of each tetrahedron, from 1; or empty. Gmsh's formats and .vtu keep them
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< faces of the mesh on boundary and interior facets
  std::vector<int> face_markers;                    ///< or empty: unknown
  std::map<int, std::string> face_names;            ///< of face markers; Gmsh's, .vtu, .inp, polyMesh keep them
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< edges of the mesh on segments
  std::vector<int> edge_markers;
  bool constrained_delaunay =
      false;  ///< does the mesh claim to be the constrained Delaunay tetrahedralization of its vertices?
};

}  // namespace ccdt::mesh
