#pragma once

#include <optional>

#include "baselines/mesher.h"
#include "baselines/mesher_description.h"

namespace ccdt::baselines {

/// TetGen (Si 2015), called as a library in this process. Without interior points (`Lattice::none`) it makes the
/// constrained Delaunay tetrahedralization of the input; with them it refines to the target edge length.
Mesher tetgen_mesher();

/// CGAL Mesh_3 (Jamin et al. 2015): Delaunay refinement of a domain bounded by the facets, with sharp edges protected
/// by balls.
Mesher cgal_mesh3_mesher();

/// CGAL Delaunay_triangulation_3 of the input's vertices: fills their convex hull and knows no facets. It is the lower
/// bound of what any Delaunay-based mesher costs.
Mesher cgal_delaunay_mesher();

/// Gmsh's HXT (Marot and Remacle 2020), run as an external program: `gmsh` on PATH, or what the environment variable
/// CCDT_GMSH says. None where there is no such program. It keeps the surface's triangles and fills the inside with
/// tetrahedra of the edge length asked for, or of those of the surface.
std::optional<Mesher> gmsh_hxt_mesher();

/// A mesher of somebody's own. Its version command is run once, when its version is asked for.
Mesher described_mesher(const MesherDescription& description);

}  // namespace ccdt::baselines
