#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/errors.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/front/advance_front.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::mesh {

/// The tetrahedra of the front and the labeled cells, with their regions: the constrained Delaunay tetrahedralization.
/// The mesh has nothing else yet.
TetMesh collect_tetrahedra(const plc::Plc& plc, const front::FrontResult& front,
                           const std::vector<RegionId>& region_of_cell, const delaunay::Delaunay& delaunay);

/// Why the tetrahedra are no mesh of the domain: their volume is not that within the facets. All cells are positive and
/// share their faces; if they have that volume too, they fill the domain once, and there is no error.
std::optional<MeshError> check_volume(const plc::Plc& plc, const facets::FacetMesh& facets,
                                      const delaunay::Delaunay& delaunay, const TetMesh& mesh);

/// Why the tetrahedra of the front are not constrained Delaunay: a face between two, or between one and a labeled cell,
/// is not locally Delaunay. This can only be if a facet is not exactly flat, so only then anything is looked at.
std::optional<MeshError> check_front(const plc::Plc& plc, const facets::FacetMesh& facets,
                                     const delaunay::Delaunay& delaunay, const front::FrontResult& front);

/// Makes the mesh whole but for its coordinates: takes the flat tetrahedra on its boundary off, gives it the faces of
/// the facets and the edges of the segments.
///
/// \return the facet of each of the mesh's faces
std::vector<std::uint32_t> finish_mesh(const plc::Plc& plc, const protection::SegmentChains& chains,
                                       facets::FacetMesh facets, TetMesh& mesh);

/// The vertices of a mesh in the units of the input. Input vertices get their original coordinates back wherever every
/// tetrahedron around stays positively oriented in the coordinates that are written, exactly tested; elsewhere they
/// stay where the grid has put them, and where improvement has moved them.
///
/// \param points     grid units; those of the PLC's vertices come first
/// \throw MeshError  a tetrahedron is inverted by writing its vertices as doubles: the part is too far from the origin
std::vector<Point3> to_world(const plc::Plc& plc, std::span<const Point3> points,
                             std::span<const std::array<std::uint32_t, 4>> tetrahedra);

}  // namespace ccdt::mesh
