#pragma once

#include "engine/folds/protect_facets.h"
#include "engine/steps/protected_domain.h"
#include "engine/steps/run.h"

namespace ccdt::steps {

/// Protects the surface, adds interior points, and finds the faces of the facets in the tetrahedralization of all
/// vertices.
///
/// \param protector   of the PLC of the domain
/// \param domain      has its PLC; gets everything else
/// \throw LimitError  a segment cannot be protected, or there are too many vertices
void protect_domain(folds::SurfaceProtector& protector, ProtectedDomain& domain, Run& run);

}  // namespace ccdt::steps
