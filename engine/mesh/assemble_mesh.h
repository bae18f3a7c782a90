#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/facets/facet_mesh.h"
#include "engine/mesh/collect_tetrahedra.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/plc.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::mesh {

/// Proves that the tetrahedra fill the domain once. All are positive and share their faces, so it suffices that their
/// volume equals that inside the facets.
///
/// \param points     the vertices, in grid units
/// \throw MeshError  the volume differs
void check_volume(const plc::Plc& plc, const facets::FacetMesh& facets, std::span<const Point3> points,
                  const TetMesh& mesh);

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

/// Leaves of these edges only those of `Segment::listed`: improvement needs folds, but no reader of the mesh does.
void drop_foreign_edges(const plc::Plc& plc, const protection::SegmentChains& chains, TetMesh& mesh);

/// The vertices of a mesh in the units of the input. Input vertices get back their original coordinates wherever every
/// tetrahedron around them stays positively oriented in the written coordinates, tested exactly. Elsewhere they keep
/// their grid positions, or the positions that improvement moved them to.
///
/// \param points     grid units; those of the PLC's vertices come first
/// \throw MeshError  writing the vertices as doubles inverts a tetrahedron: the part is too far from the origin
std::vector<Point3> to_world(const plc::Plc& plc, std::span<const Point3> points,
                             std::span<const std::array<std::uint32_t, 4>> tetrahedra);

}  // namespace ccdt::mesh
