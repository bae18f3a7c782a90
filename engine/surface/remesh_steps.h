#pragma once

#include "engine/surface/working_mesh.h"

/// The steps of isotropic remeshing (Botsch and Kobbelt 2004), each over the whole surface. An operation that would
/// turn a triangle away from the original surface, make a triangle worse than a limit, or make two edges one, is left
/// out.
namespace ccdt {

/// Splits edges longer than 4/3 of the wanted length, until there are none; new vertices are put on the original
/// surface.
void split_long_edges(WorkingMesh& m);

/// Collapses edges shorter than 4/5 of the wanted length, where that makes no edge longer than 4/3 of it.
void collapse_short_edges(WorkingMesh& m);

/// Flips edges so that vertices come near to their ideal number of neighbours: six, or fewer on a feature, as the angle
/// there asks for.
void flip_edges_for_valence(WorkingMesh& m);

/// Flips edges where that makes the worse one of the two triangles better.
void flip_edges_for_quality(WorkingMesh& m);

/// Moves vertices towards the centre of their neighbourhood, along the original surface or along their feature.
void relax_vertices(WorkingMesh& m);

}  // namespace ccdt
