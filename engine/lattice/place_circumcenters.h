#pragma once

#include "engine/base/progress.h"
#include "engine/delaunay/delaunay.h"
#include "engine/lattice/domain_surface.h"
#include "engine/lattice/options.h"
#include "engine/lattice/place_lattice_points.h"

namespace ccdt::lattice {

/// The greatest circumradius of a cell over the target edge length. With it, meshes of about 100,000 tetrahedra are
/// about as large as with a face-centered cubic lattice, whose largest circumradius is sqrt(1/2) of its edge length:
/// 11% fewer deep inside, and more near the surface.
inline constexpr double radius_per_edge = 0.83;

/// Places interior points by Delaunay refinement (Chew 1989; Ruppert 1995; in space Shewchuk 1998 and 2002): as long as
/// there is a bad cell, a vertex is inserted at its circumcenter. A cell is bad if it is *skinny*, its circumradius
/// over its shortest edge being above `options.radius_edge`, or *large*, its circumradius being above `radius_per_edge`
/// times the target edge length at its circumcenter. As for lattices, that is the edge length of the octree's leaf
/// there (`build_octree`). The cell with the largest circumradius over shortest edge comes first, up to 3 percent.
///
/// The surface is fixed, so nothing that is encroached is split. A circumcenter that is not strictly inside the domain,
/// or too near the surface by the rule for lattice points (see `place_lattice_points`), is not inserted, and its cell
/// is given up. So in the end each cell of the Delaunay tetrahedralization of the surface and all points
///
///   * is neither skinny nor large,
///   * or has its circumcenter outside the domain or too near the surface,
///   * or is skinny, not large, and has its centroid outside the domain, as in a hole or a pocket.
///
/// It terminates for every `radius_edge`. A skinny cell is also given up if a vertex is nearer to its rounded
/// circumcenter than the length of its shortest edge, and a large one if a vertex is nearer than half its radius. So no
/// two vertices get nearer to each other than the two nearest ones of the surface, or than a fixed share of the least
/// target edge length, and the domain has room for only finitely many. If `radius_edge` is at least 1, no cell is given
/// up for this reason, except by rounding, since its sphere is empty. If it is more, edges get longer by this factor
/// from one generation of vertices to the next. At 1 or slightly more, a short edge of the surface may make the whole
/// mesh fine. Nothing bounds dihedral angles: there are slivers.
///
/// Sequential, since each insertion depends on all before it. The points depend on the arguments alone: ties are
/// decided by ids, and rounded values are computed in the order of ids.
///
/// \param surface   in grid units
/// \param delaunay  of the vertices of the surface, whose ranks are less than their number
/// \return  points in the order of insertion: distinct integers in grid units, strictly inside the domain; all of one
///          level, and of no lattice
/// \throw LimitError  more points than vertex ids
LatticePoints place_circumcenters(const DomainSurface& surface, delaunay::Delaunay delaunay,
                                  const LatticeOptions& options, const Progress& progress = {});

}  // namespace ccdt::lattice
