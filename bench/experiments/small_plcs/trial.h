#pragma once

#include <string>

#include "bench/experiments/small_plcs/protection.h"
#include "bench/experiments/small_plcs/tetrahedralization.h"

namespace ccdt::small {

/// What the engine made of a small PLC, without a lattice and without improvement.
struct EngineAnswer {
  bool is_protected = false;  ///< no Steiner vertex, and no face that is not Delaunay
  bool has_steiner_vertices = false;
  std::vector<Tetrahedron> tetrahedra = {};  ///< sorted; only without Steiner vertices
  std::string failure = {};                  ///< why there is no answer
};
EngineAnswer ask_engine(const SmallPlc& plc);

/// One PLC, seen from all sides.
struct Trial {
  SmallPlc plc;
  ProtectionState protection = {};
  bool has_dt = false;  ///< the theorem's conclusion: there is a constrained Delaunay tetrahedralization of Delaunay
                        ///< tetrahedra
  SearchResult search = {};
  EngineAnswer engine = {};
  /// What our own parts disagree about among themselves, which would make the trial worthless; empty: nothing.
  std::string disagreement = {};
};
Trial try_plc(SmallPlc plc, bool is_cospherical);

}  // namespace ccdt::small
