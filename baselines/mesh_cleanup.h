#pragma once

#include "baselines/mesher.h"

namespace ccdt::baselines {

/// Makes all tetrahedra positively oriented. They must all have the same orientation.
void orient_positively(TetMesh& mesh);

/// Restores the coordinates of the input in a mesh that went through files. A vertex gets the coordinates of an input
/// vertex that equals it in 16, 15 or 11 digits, or in single precision, if all tetrahedra around it certainly stay
/// positively oriented.
/// \return  the number of vertices that changed
std::size_t restore_coordinates(const std::vector<Point3>& input, TetMesh& mesh);

/// Fills `mesh.faces` for a program that writes none: with the faces that belong to one tetrahedron, or to two in
/// different regions. They have no markers.
void add_boundary_faces(TetMesh& mesh);

/// Removes the tetrahedra enclosed by an even number of shells of facets (`InputPlc::Inside::even_odd`), and the faces,
/// edges and vertices that are then unused. `mesh.faces` are the faces on facets.
void keep_odd_regions(TetMesh& mesh);

/// Counts the elements of a mesh. A vertex with the coordinates of an input vertex is an input vertex. Any other is a
/// Steiner vertex if it is on a face or edge of `mesh.faces` or `mesh.edges`, and an interior vertex otherwise.
MeshCounts count_elements(const InputPlc& input, const TetMesh& mesh);

}  // namespace ccdt::baselines
