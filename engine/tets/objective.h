#pragma once

#include <array>

#include "engine/base/enum_names.h"

namespace ccdt::tets {

/// The quality measure to improve; its worst value counts.
enum class Objective {
  r,        ///< the paper's measure of shape (section 5); where that is good, the dihedral angles
  dihedral  ///< the least sine of the dihedral angles, so that small and large ones count alike
};

constexpr auto names_of(Objective) {
  return std::to_array<NamedValue<Objective>>(
      {{Objective::r, "r", "the paper's measure of shape, and where that is good the dihedral angles"},
       {Objective::dihedral, "dihedral", "the dihedral angles alone"}});
}

}  // namespace ccdt::tets
