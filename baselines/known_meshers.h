#pragma once

#include <optional>

#include "baselines/mesher.h"
#include "baselines/mesher_description.h"

namespace ccdt::baselines {

/// TetGen (Si 2015), called as a library. Without interior points (`Lattice::none`) it makes the constrained Delaunay
/// tetrahedralization of the input; with them it refines to the target edge length.
Mesher tetgen_mesher();

/// CGAL Mesh_3 (Jamin et al. 2015): Delaunay refinement of a domain bounded by the facets, with sharp edges protected
/// by balls.
Mesher cgal_mesh3_mesher();

/// CGAL Delaunay_triangulation_3 of the input's vertices: fills their convex hull and ignores facets. It is a lower
/// bound for the cost of any Delaunay-based mesher.
Mesher cgal_delaunay_mesher();

/// Gmsh's HXT (Marot and Remacle 2020), run as an external program: `gmsh` on PATH, or the value of the environment
/// variable CCDT_GMSH. None if there is no such program. It keeps the triangles of the surface and fills the inside
/// with tetrahedra of the target edge length, or of the surface's edge lengths.
std::optional<Mesher> gmsh_hxt_mesher();

/// A mesher that the user describes. Its version command is run once, when the version is needed.
Mesher described_mesher(const MesherDescription& description);

}  // namespace ccdt::baselines
