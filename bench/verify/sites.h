#pragma once

#include "bench/verify/topology.h"
#include "engine/plc/input.h"

namespace ccdt::verification {

/// The places of the input's vertices, named by the mesh's vertices that are there, so that the input can be compared
/// with the mesh by indices. A place where the mesh has no vertex gets a number behind those of the mesh.
struct Sites {
  std::vector<std::uint32_t> of_input;  ///< site of each input vertex
  std::vector<Point3>
      position;  ///< of each site, as the input has it; of a vertex that is not in the input, as the mesh
  std::uint32_t mesh_vertices = 0;

  bool in_mesh(std::uint32_t site) const { return site < mesh_vertices; }
};

/// Matches exact coordinates first, then the nearest vertex in use within `tolerance`.
Sites match_sites(const InputPlc& input, const TetMesh& mesh, const Topology& topology, double tolerance);

}  // namespace ccdt::verification
