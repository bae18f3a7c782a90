#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "engine/base/raw_vector.h"
#include "engine/delaunay/delaunay.h"
#include "engine/front/advance_front.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/plc.h"

namespace ccdt::mesh {

/// The attribute of all regions in the domain, if they share one.
std::optional<int> common_attribute(std::span<const plc::Region> regions);

/// The constrained Delaunay tetrahedralization as a mesh, and where its tetrahedra come from.
struct CollectedMesh {
  TetMesh mesh;
  /// By tetrahedron: its Delaunay cell; numbers beyond the cells are those of the front's tetrahedra.
  RawVector<std::uint32_t> sources;
};

/// The tetrahedra of the front and the labeled cells, with their regions unless these have a common attribute. The mesh
/// has nothing else yet.
///
/// Their order, and the order of the corners of each, depends only on the set of tetrahedra: the mesh is the same, byte
/// for byte, with any strategy and any number of threads. The first corner of each is its least vertex. Tetrahedra that
/// are close in space are mostly close in this order, because interior vertices are numbered along a space-filling
/// curve.
///
/// \param region_of_cell  see `label::CellLabels`
/// \param cells           of the Delaunay tetrahedralization
/// \param vertices        how many it has
CollectedMesh collect_tetrahedra(const plc::Plc& plc, const front::FrontResult& front,
                                 RawVector<RegionId> region_of_cell, const LargeVector<delaunay::Cell>& cells,
                                 std::size_t vertices);

/// The tetrahedra of the mesh as cells, in the same order. Two that come from Delaunay cells with a common face are
/// neighbors; the other neighbors are missing (`no_neighbor`).
///
/// \param sources  of the tetrahedra, see `CollectedMesh`
/// \param cells    of the Delaunay tetrahedralization; their memory is reused
LargeVector<delaunay::Cell> join_tetrahedra(const TetMesh& mesh, RawVector<std::uint32_t> sources,
                                            LargeVector<delaunay::Cell> cells);

}  // namespace ccdt::mesh
