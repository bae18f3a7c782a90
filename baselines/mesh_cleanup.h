#pragma once

#include "baselines/mesher.h"

namespace ccdt::baselines {

/// Makes all tetrahedra positively oriented, given that they are all oriented alike.
void orient_positively(TetMesh& mesh);

/// Restores the input's coordinates in a mesh that was written and read: those of vertices that equal an input vertex
/// in 16 or 15 digits, or in single precision, as programs read and write them, wherever all tetrahedra around surely
/// stay positively oriented.
/// \return  how many vertices have other coordinates now
std::size_t restore_coordinates(const std::vector<Point3>& input, TetMesh& mesh);

/// Fills `mesh.faces` for a program that writes none: with the faces of one tetrahedron, and of two that are in
/// different regions. Their markers are 0.
void add_boundary_faces(TetMesh& mesh);

/// Removes the tetrahedra that an even number of shells of facets encloses (`InputPlc::Inside::even_odd`), with the
/// faces, edges and vertices that nothing uses any more. `mesh.faces` are the faces on facets.
void keep_odd_regions(TetMesh& mesh);

/// Counts the elements of a mesh. A vertex is the input's if its coordinates are; any other is a Steiner vertex if it
/// is on a face or edge of `mesh.faces` or `mesh.edges`, else an interior vertex.
MeshCounts count_elements(const InputPlc& input, const TetMesh& mesh);

}  // namespace ccdt::baselines
