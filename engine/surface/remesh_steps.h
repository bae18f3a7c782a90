#pragma once

#include "engine/surface/working_mesh.h"

namespace ccdt::surface {

/// \name The steps of isotropic remeshing (Botsch and Kobbelt 2004), each over the whole surface.
/// An operation that would turn a triangle away from the original surface, make a triangle worse than a limit, or make
/// two edges one, is left out.
/// @{

/// Gives every vertex and knot the edge length that is wanted there (`EdgeLengths`), but less around edges that are
/// much shorter and could not be collapsed, because the surface is too narrow or too strongly curved there: long edges
/// beside them would make needles of the triangles.
void find_wanted_lengths(WorkingMesh& m);

/// Splits edges longer than 4/3 of the wanted length, until there are none; new vertices are put on the original
/// surface.
void split_long_edges(WorkingMesh& m);

/// Collapses edges shorter than 4/5 of the wanted length, where that makes no edge longer than 4/3 of it.
void collapse_short_edges(WorkingMesh& m);

/// Flips edges so that vertices come near to their ideal number of neighbors: six, or fewer on a feature, as the angle
/// there asks for.
void flip_edges_for_valence(WorkingMesh& m);

/// Flips edges where that makes the worse one of the two triangles better.
void flip_edges_for_quality(WorkingMesh& m);

/// Moves vertices towards the center of their neighborhood, along the original surface or along their feature.
void relax_vertices(WorkingMesh& m);

/// Flips, collapses and moves around triangles with small angles, the worst first and whatever the wanted lengths,
/// until nothing helps. Every change makes the smallest angle of all triangles that it touches larger.
void improve_worst_triangles(WorkingMesh& m);
/// @}

/// \name The changes of `improve_worst_triangles`: each is made if it is an improvement.
/// \return whether it was made
/// @{
bool improve_by_flip(WorkingMesh& m, EdgeHandle e);
bool improve_by_collapse(WorkingMesh& m, HalfedgeHandle h);  ///< draws the start of the halfedge to its end
bool improve_by_move(WorkingMesh& m, VertexHandle v);        ///< along the surface, or along the feature it is on
/// @}

}  // namespace ccdt::surface
