#pragma once

#include <vector>

#include "engine/mesh/tet_mesh.h"
#include "engine/plc/input.h"

namespace ccdt::io {

/// Seeds that tell which parts of space the tetrahedra of a mesh fill.
struct MeshSeeds {
  std::vector<plc::InputPlc::RegionSeed> regions;  ///< one in each part that the faces bound
  std::vector<Point3> cavities;                    ///< one in each
};

/// Adds to the faces of a mesh those on its boundary and between its regions, with marker 0.
MeshSeeds bound_regions(mesh::TetMesh& mesh);

}  // namespace ccdt::io
