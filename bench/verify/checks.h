#pragma once

#include <unordered_map>

#include "bench/verify/match_facets.h"
#include "bench/verify/regions.h"
#include "bench/verify/verify.h"

/// The checks, each with what must hold.
namespace ccdt::verify {

/// \name The tetrahedra by themselves (check_cells.cpp).
/// @{

/// Coordinates are finite.
Check check_coordinates(const mesh::TetMesh& mesh);

/// Every tetrahedron has four different vertices that exist, and attribute arrays have one entry an element.
Check check_indices(const mesh::TetMesh& mesh);

/// Every tetrahedron is positively oriented, exactly.
Check check_orientation(const mesh::TetMesh& mesh, const Progress& progress);

/// No two vertices that tetrahedra use are in one place.
Check check_distinct_vertices(const mesh::TetMesh& mesh, const Topology& topology);

/// Every vertex is used by a tetrahedron (not required).
Check check_used_vertices(const mesh::TetMesh& mesh, const Topology& topology);

/// Every face is of one tetrahedron, or of two on opposite sides.
Check check_shared_faces(const mesh::TetMesh& mesh, const Topology& topology);

/// @}
/// \name The facets of the input in the mesh (check_facets.cpp).
/// @{

/// Every input vertex in or on the domain is a vertex of the mesh, unless it may slide.
Check check_vertices(const plc::InputPlc& input, const Surface& surface, const Regions& regions,
                     const RayShooter& rays);

/// Every segment and every feature edge in or on the domain is a chain of mesh edges.
Check check_segments(const Surface& surface, const Chains& edges, const Chains& segments,
                     const std::vector<bool>& features, const Regions& regions, const RayShooter& rays);

/// Every facet that the domain touches is there: as a boundary if one side is inside, else as inner faces.
Check check_facets(const Surface& surface, const FacetMatches& matches, const Regions& regions);

/// Every boundary face of the mesh stands for an input facet.
Check check_boundary(const mesh::TetMesh& mesh, const Topology& topology, const FacetMatches& matches);

/// @}
/// \name The domain and its regions (check_domain.cpp).
/// @{

/// In which region of the input each tetrahedron is.
struct RegionsOfTetrahedra {
  std::vector<std::uint32_t> region;     ///< of each tetrahedron; `none` for those that no facet bounds
  std::vector<std::uint32_t> conflicts;  ///< tetrahedra that are reached from two regions without crossing a facet
  /// Of each tetrahedron that lies within an interior facet, since that is flat only within the tolerance: the region
  /// on the other side of the facet. It could as well be there.
  std::unordered_map<std::uint32_t, std::uint32_t> other_region;
};

/// Floods the mesh from the faces that stand for facets.
/// \param flat  how far from its plane an interior facet reaches
RegionsOfTetrahedra assign_regions(const mesh::TetMesh& mesh, const Topology& topology, const Regions& regions,
                                   const FacetMatches& matches, double flat);

/// Decides the regions of which the input does not tell whether they are inside, by whether the mesh fills them.
void resolve_unknown(const RegionsOfTetrahedra& assigned, Regions& regions);

/// Every tetrahedron is in one region, and that is inside.
Check check_domain(const mesh::TetMesh& mesh, const Regions& regions, const RegionsOfTetrahedra& assigned);

/// A tetrahedron has the attribute of the region seed in its region; without a seed, the same as all in the region.
/// One that lies within an interior facet may have the attribute of either side.
Check check_regions(const mesh::TetMesh& mesh, const Regions& regions, const RegionsOfTetrahedra& assigned);

/// No tetrahedron is in a region with a hole's point.
Check check_holes(const plc::InputPlc& input, const Regions& regions, const RegionsOfTetrahedra& assigned);

double mesh_volume(const mesh::TetMesh& mesh);
double input_volume(const Surface& surface, const Regions& regions);

/// The volumes are equal to 1e-9, and what moving the surface within the tolerance can change.
Check check_volume(const Surface& surface, const Regions& regions, double of_mesh, double of_input);

/// @}
/// \name The Delaunay property (check_delaunay.cpp).
/// @{

struct DelaunayChecks {
  Check local;      ///< faces that are not locally Delaunay, beyond what rounding explains
  Check explained;  ///< exactly seen not locally Delaunay, but within what rounding explains (not required)
};

/// Every inner face that stands for no facet is locally Delaunay: the vertex behind it is not strictly inside the
/// circumsphere of the tetrahedron before it. By the Delaunay lemma for constrained Delaunay tetrahedralizations the
/// mesh is then one (Shewchuk 2008).
///
/// The coordinates that a mesher worked with may differ from those in the mesh, because it rounds them. A violation is
/// explained by that if moving each coordinate by `rounding` can change the sign of the determinant (to first order).
///
/// \param constrained  of each face: does it stand for a facet?
DelaunayChecks check_delaunay(const mesh::TetMesh& mesh, const Topology& topology, const std::vector<bool>& constrained,
                              double rounding, bool required, const Progress& progress);

/// @}

}  // namespace ccdt::verify
