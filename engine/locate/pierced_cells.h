#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/hash_table.h"
#include "engine/delaunay/cell_star.h"
#include "engine/delaunay/delaunay.h"
#include "engine/facets/facet_mesh.h"

namespace ccdt {

/// The Delaunay cells that missing faces go through, in parts that are connected through their faces.
struct PiercedCells {
  std::vector<std::uint32_t> part_of_face;          ///< of each missing face
  std::vector<std::vector<std::uint32_t>> cells;    ///< of each part
  HashTable<std::uint32_t, std::uint32_t> part_of;  ///< by cell
};

/// Finds the finite cells that meet the inside of some missing face: those that it cuts, and those that touch it with
/// an edge or a face within its plane. They are connected, so each face has one part.
///
/// \param missing  numbers of triangles of `facets` that are no Delaunay faces
PiercedCells find_pierced_cells(const FacetMesh& facets, std::span<const std::uint32_t> missing,
                                const Delaunay& delaunay, CellStar& star);

}  // namespace ccdt
