#pragma once

#include <cstdint>

#include "engine/base/progress.h"
#include "engine/base/stages.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/options/mesh_options.h"
#include "engine/plc/input.h"

namespace ccdt {

struct MeshResult {
  TetMesh mesh;
  MeshCounts counts;
  StageCosts costs;
  double largest_rounding = 0;   ///< largest change of an input coordinate, in the units of the input
  std::uint64_t idle_holes = 0;  ///< seeds of holes where nothing is enclosed; they were not used
};

/// On how many threads `mesh_plc` works at most with these options. By default, it does on one what is done sooner than
/// others can start.
unsigned number_of_threads(const MeshOptions& options);

/// \throw LimitError  there are more tetrahedra than `MeshOptions::most_tetrahedra`
void check_count(std::uint64_t tetrahedra, double most);

/// Meshes a piecewise linear complex by conforming constrained Delaunay tetrahedralization (Yang, Yong, Sun 2005).
///
/// \param input       facets in any units, which also apply to lengths and to the mesh; polygons that are not planar
///                    are triangulated so that they bend least. With `remesh` and `automatic`, the surface of the mesh
///                    is the one that `surface::remesh_surface` makes
/// \param options     strategies, sizes and targets of improvement
/// \param progress    called repeatedly; throw from it to cancel: the exception reaches the caller, and all memory is
///                    released
/// \throw InputError  the input is not a valid PLC, an option is out of range, or remeshing has no edge length
/// \throw LimitError  a segment would need a split finer than the grid allows, the mesh would have too many vertices or
///                    tetrahedra, or no sizes give the wanted number of tetrahedra
/// \throw MeshError   no valid mesh or new surface was found
/// \throw ...         any exception of `progress`
MeshResult mesh_plc(const InputPlc& input, const MeshOptions& options = {}, const Progress& progress = {});

}  // namespace ccdt
