#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"
#include "engine/front/advance_front.h"
#include "engine/front/stuck.h"
#include "engine/mesh/collect_tetrahedra.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::mesh {

/// The error if the volume of the tetrahedra differs from that inside the facets. All cells are positive and share
/// their faces; if the volume is right too, they fill the domain once, and there is no error.
///
/// \param points  the vertices, in grid units
std::optional<front::Stuck> check_volume(const plc::Plc& plc, const facets::FacetMesh& facets,
                                         std::span<const Point3> points, const TetMesh& mesh);

/// The error if the tetrahedra of the front are not constrained Delaunay: a face between two, or between one and a
/// labeled cell, is not locally Delaunay. That is possible only if a facet is not exactly flat, so nothing is tested
/// otherwise.
std::optional<front::Stuck> check_front(const plc::Plc& plc, const facets::FacetMesh& facets,
                                        const delaunay::Delaunay& delaunay, const front::FrontResult& front);

/// Completes the mesh except for its coordinates: removes the flat tetrahedra on its boundary, and adds the faces of
/// the facets and the edges of the segments.
///
/// \param points  the vertices, in grid units
/// \return the facet of each of the mesh's faces
std::vector<std::uint32_t> finish_mesh(const plc::Plc& plc, const protection::SegmentChains& chains,
                                       std::span<const Point3> points, facets::FacetMesh facets,
                                       CollectedMesh& collected);

/// Gives a mesh the edges of the segments, with their markers.
void list_edges(const plc::Plc& plc, const protection::SegmentChains& chains, TetMesh& mesh);

/// The vertices of a mesh in the units of the input. Input vertices get back their original coordinates wherever every
/// tetrahedron around them stays positively oriented in the written coordinates, tested exactly. Elsewhere they keep
/// their grid positions, or those to which improvement moved them.
///
/// \param points     grid units; those of the PLC's vertices come first
/// \throw MeshError  writing the vertices as doubles inverts a tetrahedron: the part is too far from the origin
std::vector<Point3> to_world(const plc::Plc& plc, std::span<const Point3> points,
                             std::span<const std::array<std::uint32_t, 4>> tetrahedra);

}  // namespace ccdt::mesh
