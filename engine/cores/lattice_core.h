#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/cores/site_blocks.h"
#include "engine/delaunay/delaunay.h"

namespace ccdt::cores {

/// The part of a Delaunay tetrahedralization that follows from the lattices alone; docs/lattice-cores.md has the proof.
///
/// The spheres of a perfect lattice hold the vertices of *shapes*. They are placed in steps: half the side of a lattice
/// cell, or the whole side for `sc`.
///
/// - `fcc`: octahedra around the points of odd sum, and tetrahedra in the unit cubes between
/// - `bcc`: four tetrahedra around the face of two cells, that is, around the axis between their centers
/// - `sc`: cubes
///
/// A shape is *core* if all of its vertices are there and its closed spheres hold no other vertex. A vertex is *deep*
/// if all its shapes are core. The core kept here is that of the shapes that have a deep vertex.
struct LatticeCore {
  SiteBlocks sites;
  std::vector<bool> is_deep;     ///< by vertex
  std::uint32_t cell_count = 0;  ///< of all the shapes
};

/// \param lattice  the interior points
/// \param vertex   by point: its vertex, which is its rank as well; or `nothing`, and it is taken for absent
/// \param others   all vertices that are no lattice points, and the only ones that are not
/// \param vertices how many there are in all
LatticeCore find_lattice_core(const lattice::LatticePoints& lattice, const std::vector<std::uint32_t>& vertex,
                              std::span<const Point3> others, std::size_t vertices);

/// Makes the cells of the core and joins them to each other.
///
/// \param cells  one for each cell of the core
/// \param first  the number of the first one, for the codes of neighbors
/// \return       codes of the faces that no two of them share
std::vector<std::uint32_t> make_core_cells(const LatticeCore& core, std::span<delaunay::Cell> cells,
                                           std::uint32_t first);

/// Puts the core into the tetrahedralization of the other vertices: cells of that within the core go, found by a flood
/// from the core's border, and those outside become neighbors of the core's.
///
/// \param d  the Delaunay tetrahedralization of at least all vertices that are not deep; its list of vertices has all
void insert_core(const LatticeCore& core, delaunay::Delaunay& d);

}  // namespace ccdt::cores
