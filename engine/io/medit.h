#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/mesh/tet_mesh.h"
#include "engine/plc/input.h"

namespace ccdt::io {

/// What Medit's files have, in text and in binary: surfaces and tetrahedral meshes alike. Each element has a
/// "reference".
struct MeditFile {
  mesh::TetMesh mesh;
  std::vector<std::array<std::uint32_t, 4>> quadrilaterals;
  std::vector<int> quadrilateral_references;
  std::size_t first_triangle = 0, first_quadrilateral = 0;  ///< how many facets came before them in the file
  std::vector<std::string> notes;                           ///< as in `plc::InputPlc`

  bool has_facets() const { return !mesh.faces.empty() || !quadrilaterals.empty(); }
};

/// As a surface or PLC: if there are tetrahedra, the boundaries of their regions (`surface_of`).
///
/// \param inside  what the caller knows from the file's claim, if there are only facets
plc::InputPlc plc_of(MeditFile medit, plc::InputPlc::Inside inside);

/// Of a PLC whose facets are triangles and quadrilaterals.
MeditFile medit_of(const plc::InputPlc& plc);

}  // namespace ccdt::io
