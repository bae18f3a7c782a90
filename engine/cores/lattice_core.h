#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/cores/site_blocks.h"
#include "engine/delaunay/delaunay.h"

namespace ccdt::cores {

/// The part of a Delaunay tetrahedralization that follows from the lattices alone; docs/lattice-cores.md has the proof.
///
/// The empty spheres of a perfect lattice circumscribe *shapes*. Places are given in steps: half the side of a lattice
/// cell, or the whole side for `sc`.
///
/// - `fcc`: octahedra around the points of odd sum, and tetrahedra in the unit cubes between
/// - `bcc`: four tetrahedra around the face of two cells, that is, around the axis between their centers
/// - `sc`: cubes
///
/// A shape is *core* if all of its vertices exist and its closed spheres contain no other vertex. A vertex is *deep* if
/// all its shapes are core. The core kept here consists of the core shapes with a deep vertex.
struct LatticeCore {
  SiteBlocks sites;
  std::vector<std::uint8_t> is_deep;  ///< by vertex
  std::uint32_t cell_count = 0;       ///< of all core shapes with a deep vertex
};

/// \param lattice  the interior points
/// \param vertex   by point: its vertex, which is also its rank; or `none` if it is absent
/// \param others   all vertices that are not lattice points
/// \param vertices the number of all vertices
LatticeCore find_lattice_core(const lattice::LatticePoints& lattice, std::span<const std::uint32_t> vertex,
                              std::span<const Point3> others, std::size_t vertices);

/// Makes the cells of the core and joins them to each other. For each of their vertices, notes its last core cell.
///
/// \param d      has room for the cells
/// \param first  the first of these cells; cells before it are older
/// \return       codes of the faces that belong to only one of them
std::vector<std::uint32_t> make_core_cells(const LatticeCore& core, delaunay::Delaunay& d, std::uint32_t first);

/// Adds the points of a lattice to a tetrahedralization: like `delaunay::insert_points`, with the same result, but the
/// cells deep within the lattice are written down, and only vertices that are not deep are inserted.
///
/// \return  the number of cells in the core
std::size_t insert_points(const lattice::LatticePoints& lattice, delaunay::Delaunay& d, const Progress& progress = {});

}  // namespace ccdt::cores
