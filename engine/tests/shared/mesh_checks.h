#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/verify/verify.h"
#include "engine/mesher.h"

namespace ccdt::mesh_test {

/// The tetrahedra as sorted lists of sorted vertices.
std::vector<std::array<std::uint32_t, 4>> sorted_cells(const TetMesh& mesh);

void expect_same_cells(const TetMesh& a, const TetMesh& b);

/// The independent verification finds nothing wrong.
void expect_right(const InputPlc& input, const TetMesh& mesh, const verify::VerifyOptions& options = {});

/// The same, and the mesh claims to be constrained Delaunay.
void expect_verified(const InputPlc& input, const TetMesh& mesh);

/// Meshes with one lattice and verifies the mesh. Expects the very same tetrahedra without the face protection check,
/// both with all Steiner vertices and with only the necessary ones.
///
/// \return  the result with the check and all Steiner vertices
MeshResult expect_agreement(const InputPlc& input, Lattice lattice, Protection protection = Protection::shell);

/// The same with every lattice and both protections.
void expect_agreement_of_all_strategies(const InputPlc& input);

/// Brute force with CGAL's exact kernel: if a vertex is strictly inside the circumsphere of a tetrahedron, a facet
/// hides it from every tested point inside the tetrahedron (`seed` chooses the points). Only for small meshes whose
/// facets are exactly flat.
void expect_constrained_delaunay(const TetMesh& mesh, unsigned seed);

}  // namespace ccdt::mesh_test
