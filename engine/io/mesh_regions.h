#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/tet_mesh.h"
#include "engine/plc/input.h"

namespace ccdt::io {

/// Adds to the faces of a mesh those on its boundary and between its regions, with marker 0.
///
/// \return  of its tetrahedra: a seed in each part that these faces bound, with its attribute
std::vector<plc::InputPlc::RegionSeed> bound_regions(mesh::TetMesh& mesh);

/// A point in each cavity of the tetrahedra.
std::vector<Point3> cavity_seeds(const mesh::TetMesh& mesh);

}  // namespace ccdt::io
