#pragma once

#include "engine/steps/protected_domain.h"
#include "engine/steps/run.h"

namespace ccdt::steps {

/// Makes the faces part of the tetrahedralization, and a mesh of the space that they enclose.
///
/// \param domain     keeps only its PLC, its chains, and the number of the first interior vertex
/// \throw MeshError  the front got stuck, or the tetrahedra do not fill the domain
Tetrahedralization fill_domain(ProtectedDomain& domain, Run& run);

}  // namespace ccdt::steps
