#pragma once

#include "engine/base/progress.h"
#include "engine/plc/input.h"
#include "engine/plc/plc.h"

namespace ccdt::plc {

struct PlcOptions {
  double flatness = 1e-8;  ///< tolerance for the vertices of a patch to be in one plane, so that it is one facet; as a
                           ///< fraction of the box
};

/// Puts the input on the dyadic grid, merges equal vertices, finds facets, segments and regions, and checks that they
/// form a piecewise linear complex. Facets without area on the grid bound nothing and are left out; their vertices
/// stay.
///
/// \throw InputError  non-finite coordinates, duplicate facets, facets that cross or cover each other, an
///                    open surface, no facets, seeds outside; with the place in the units of the input and a remedy
Plc build_plc(const InputPlc& input, const PlcOptions& options = {}, const Progress& progress = {});

}  // namespace ccdt::plc
