#pragma once

#include "engine/surface/working_mesh.h"

/// Makes the worst triangles better, whatever the wanted lengths. Every change lets the smallest angle of all triangles
/// that it touches grow, keeps the limits of remeshing (`remesh_steps.h`) and is made where triangles are bad only.
namespace ccdt {

/// Flips, collapses and moves around triangles with small angles, the worst first, until nothing helps.
void improve_worst_triangles(WorkingMesh& m);

/// \name The changes: each is made if it is an improvement, and tells so.
/// @{
bool improve_by_flip(WorkingMesh& m, EdgeHandle e);
bool improve_by_collapse(WorkingMesh& m, HalfedgeHandle h);  ///< draws the start of the halfedge to its end
bool improve_by_move(WorkingMesh& m, VertexHandle v);        ///< along the surface, or along the feature it is on
/// @}

}  // namespace ccdt
