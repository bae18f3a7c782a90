#pragma once

#include "baselines/mesher.h"

namespace ccdt {

/// The input with vertices of equal coordinates made one: surface formats repeat a vertex in every triangle, and the
/// other meshers want them shared. Triangles, polygons and segments keep their order.
InputPlc merge_equal_vertices(const InputPlc& input);

/// Median length of the edges of the input's triangles and polygons; 0 without any.
double median_edge_length(const InputPlc& input);

/// The edge length that a mesh is asked for: the option's, or where it is 0 that of the surface.
double target_edge_length(const InputPlc& input, const MeshOptions& options);

/// Volume of the regular tetrahedron of this edge length.
double regular_tetrahedron_volume(double edge_length);

/// Volume of the largest tetrahedron of a mesh of this edge length: twice that of the regular one, which is about the
/// average.
double largest_tetrahedron_volume(double edge_length);

/// Makes all tetrahedra positively oriented, given that they are all oriented alike.
void orient_positively(TetMesh& mesh);

/// Gives vertices of a mesh that was written and read the coordinates back that the input has: those that equal an
/// input vertex's in 16 or 15 digits, or in single precision, as programs read and write them, wherever all tetrahedra
/// around surely stay positively oriented.
/// \return  how many have other coordinates now
std::size_t restore_coordinates(const std::vector<Point3>& input, TetMesh& mesh);

/// Fills `mesh.faces` of a mesh of a program that writes none: the faces of one tetrahedron, and of two that are of
/// different regions. Their markers are 0.
void add_boundary_faces(TetMesh& mesh);

/// Removes the tetrahedra that an even number of shells of facets encloses (`InputPlc::Inside::even_odd`), with the
/// faces, edges and vertices that nothing uses any more. `mesh.faces` are the faces on facets.
void keep_odd_regions(TetMesh& mesh);

/// Counts what a mesh of another program has. A vertex is the input's if its coordinates are; any other is a Steiner
/// vertex if it is on a face or edge of `mesh.faces` or `mesh.edges`, else an interior vertex.
MeshCounts count_elements(const InputPlc& input, const TetMesh& mesh);

/// The shortest digits that read back bit for bit.
std::string digits(double value);

}  // namespace ccdt
