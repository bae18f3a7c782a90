#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "bench/experiments/experiment.h"
#include "engine/mesh/tet_mesh.h"

namespace ccdt::experiments {

/// The tetrahedra of a mesh that have a vertex on its surface, and the slivers among them.
struct SurfaceSlivers {
  std::uint64_t tetrahedra = 0;
  std::uint64_t below_5_degrees = 0, below_10_degrees = 0;  ///< with a smaller dihedral angle
  std::uint64_t with_large_r = 0;                           ///< r above 5
  std::uint64_t with_interior_vertex = 0;                   ///< of those below 5 degrees
  double smallest_dihedral = 180;                           ///< degrees
  double worst_r = 1;

  double per_thousand(std::uint64_t slivers) const {
    return tetrahedra == 0 ? 0 : 1000 * static_cast<double>(slivers) / static_cast<double>(tetrahedra);
  }
};

/// \pre the mesh lists its faces on boundary and interior facets
SurfaceSlivers slivers_at_surface(const mesh::TetMesh& mesh);

/// A surface, filled with or without each of the two rules that keep lattice points away from it.
struct MinSphereRow : CaseRow {
  std::string model;
  bool sphere_rule = false;     ///< the paper's: no lattice point in the smallest sphere of a face
  bool clearance_rule = false;  ///< ours: none near the surface
  std::optional<SurfaceSlivers> slivers = {};
};

/// Does the rule of smallest spheres avoid slivers (paper, section 3, after Cavendish, Field and Frey 1985)? Makes
/// unimproved FCC meshes of the paper's models and the user's files, with and without this rule, and each with and
/// without our clearance rule.
ExperimentResult measure_min_sphere(const ExperimentOptions& options, bench::Runner& runner);

/// \param rows  grouped by model
ExperimentResult min_sphere_result(std::span<const MinSphereRow> rows);

}  // namespace ccdt::experiments
