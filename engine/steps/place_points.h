#pragma once

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/lattice/place_lattice_points.h"
#include "engine/plc/plc.h"
#include "engine/protection/protect_edges.h"
#include "engine/steps/run.h"

namespace ccdt::steps {

/// Places interior points away from the faces and the segments.
///
/// \param surface  may get more splits, to make room for points
/// \return  none if the lattice is `none`
lattice::LatticePoints place_points(const plc::Plc& plc, const facets::FacetMesh& facets,
                                    protection::ProtectedDelaunay& surface, Run& run);

/// The Delaunay tetrahedralization of the surface's vertices and the points, by the method of the options.
///
/// \param points  their memory is free afterward
delaunay::Delaunay add_points(lattice::LatticePoints points, delaunay::Delaunay surface, Run& run);

}  // namespace ccdt::steps
