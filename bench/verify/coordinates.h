#pragma once

#include "engine/mesh/tet_mesh.h"
#include "engine/plc/input.h"

namespace ccdt::verify {

struct InputAndMesh {
  plc::InputPlc input;
  mesh::TetMesh mesh;
};

/// An input and its mesh as they are inside the engine: the vertices of the input are rounded to the dyadic grid, by at
/// most 2^-32 of the box, and so are the mesh's vertices that are among them. Coordinates are relative to the origin of
/// the grid, so that they are exact.
InputAndMesh put_on_grid(const plc::InputPlc& input, const mesh::TetMesh& mesh);

/// An input and its mesh with all coordinates multiplied by a number.
InputAndMesh scale_by(double factor, const plc::InputPlc& input, const mesh::TetMesh& mesh);

}  // namespace ccdt::verify
