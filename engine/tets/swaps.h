#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/tets/cell_complex.h"

/// Plans of changes that replace cells. They do not change the complex; they write the best change into `change` and
/// return whether there is one. The quality of the worst new cell must be greater than `least`, which is not less than
/// that of `cell`. The new cells are not yet tested for exact positivity.
namespace ccdt::tets {

/// The quality of the worst of some cells.
double worst_of(const std::vector<NewCell>& cells);

/// The longest ring of vertices around an edge to try.
inline constexpr std::uint32_t longest_ring = 8;

/// Is a triangle not yet a face, and upright on a facet? Exact. Positive cells alone do not keep new faces from folding
/// over: a nearly flat facet has cells with all corners on it.
bool is_new_and_upright(const CellComplex& complex, const Triangle& corners, std::uint32_t facet);

/// Plans to remove an edge: the cells around it are replaced by the best of all triangulations of the ring of vertices
/// around it, each of its triangles joined to both ends of the edge (Shewchuk 2002, "Two discrete optimization
/// algorithms for the topological improvement of tetrahedral meshes"; the dynamic programming is Klincsek's). A ring of
/// three gives the 3-2 swap, one of four the 4-4 swap. An edge on a facet that is not a segment is removed on both
/// sides of the facet: the 2-2 and 4-4 swaps on facets, and larger ones.
///
/// \param edge   of the cell, 0 to 5: between its vertices 0 1, 0 2, 0 3, 1 2, 1 3, 2 3
bool plan_edge_removal(const CellComplex& complex, CellId cell, std::uint32_t edge, double least, Change& change);

/// Plans to remove a face, and with it more faces between the two cells' apexes: the cells on both sides of these are
/// replaced by cells around the edge between the apexes (Shewchuk 2002; the 2-3 swap is the case of one face).
///
/// \param face   of the cell, 0 to 3
bool plan_face_removal(const CellComplex& complex, CellId cell, std::uint32_t face, double least, Change& change);

/// Kinds of swaps.
enum class Swap { none, edge_removal, face_removal };

/// Plans the best of all swaps that involve a cell and improve it, and tests that exactly.
///
/// \param scratch  working memory
/// \return         its kind; none if there is no such swap. In any case, `Change::space_taken` encloses the space of
///                 all plans.
Swap plan_best_swap(const CellComplex& complex, CellId cell, Change& scratch, Change& change);

}  // namespace ccdt::tets
