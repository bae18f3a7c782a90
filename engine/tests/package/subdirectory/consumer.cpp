#include <ccdt/ccdt.h>

#include "engine/mesher.h"

static_assert(CCDT_VERSION_MAJOR >= 0 && !ccdt::engine_version.empty());

// With the engine's own warnings this would be one.
std::size_t tetrahedra_of(const ccdt::InputPlc& input) {
  const ccdt::MeshResult result = ccdt::mesh_plc(input);
  if (const std::size_t input = result.mesh.tetrahedra.size()) return input;
  return 0;
}
