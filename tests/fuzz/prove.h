#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/mesher.h"

namespace ccdt::fuzz {

struct ProofOptions {
  double seconds = 20;  ///< of CPU time for one mesh; one that takes longer counts as endless
  std::vector<Lattice> lattices = {Lattice::fcc};  ///< beside none
  bool refined = true;                             ///< also refine the surface, which takes half of the time
};

/// The outcome for one PLC.
struct Proof {
  enum class Outcome {
    right,    ///< all strategies agree, and all meshes are right
    invalid,  ///< the engine refuses the input
    endless,  ///< a mesh took too long, or a limit was reached
    wrong     ///< strategies disagree, or a mesh is wrong or missing
  };
  Outcome outcome = Outcome::right;
  std::string what = {};       ///< the error, and the mesh that has it
  std::uint64_t meshes = 0;    ///< how many were made
  std::uint64_t verified = 0;  ///< how many of them were verified
};

/// Meshes a PLC with all strategies, compares their tetrahedra as sorted lists, and verifies the common result: with
/// both protections of edges, with and without face protection, with all locators and both ways to the Delaunay
/// tetrahedralization (each pair of values at least once), with lattices, improved, and with a refined surface.
///
/// With `Protection::midpoint`, splitting need not end; then there is nothing to compare.
Proof prove(const InputPlc& input, const ProofOptions& options = {});

/// Removes facets, segments, vertices and seeds as long as the rest is still interesting.
///
/// \pre `is_interesting(input)`
InputPlc reduce(InputPlc input, const std::function<bool(const InputPlc&)>& is_interesting);

}  // namespace ccdt::fuzz
