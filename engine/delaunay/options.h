#pragma once

#include <array>

#include "engine/base/enum_names.h"

namespace ccdt::delaunay {

/// How to make the Delaunay tetrahedralization; the result is the same.
enum class DelaunayMethod {
  insert,  ///< vertex by vertex along a Hilbert curve (Bowyer, Watson)
  core,    ///< the same, except for the cells deep within a lattice, which are known
  wrap     ///< face by face with a uniform grid (paper, section 5; Fang and Piegl 1993)
};

constexpr auto names_of(DelaunayMethod) {
  return std::to_array<NamedValue<DelaunayMethod>>(
      {{DelaunayMethod::insert, "insert", "vertex by vertex along a space-filling curve"},
       {DelaunayMethod::core, "core", "cells deep within a lattice are written down, the others as with insert"},
       {DelaunayMethod::wrap, "wrap", "face by face in a uniform grid, as in the paper"}});
}

}  // namespace ccdt::delaunay
