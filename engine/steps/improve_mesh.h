#pragma once

#include "engine/steps/protected_domain.h"
#include "engine/steps/run.h"

namespace ccdt::steps {

/// Does anything remain to be done to the constrained Delaunay tetrahedralization?
bool improves(const ProtectedDomain& domain, const Run& run);

/// Removes Steiner vertices and bad or large tetrahedra, as requested by the options, and counts again.
void improve_mesh(ProtectedDomain& domain, Tetrahedralization& t, Run& run);

}  // namespace ccdt::steps
