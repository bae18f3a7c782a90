#pragma once

#include "engine/improve/change_cells.h"

namespace ccdt {

/// The longest ring of vertices around an edge that is tried.
inline constexpr std::uint32_t longest_ring = 8;

/// Plans to remove an edge: the cells around it give way to the best of all triangulations of the ring of vertices
/// around it, each of its triangles joined to both ends of the edge (Shewchuk 2002, "Two discrete optimization
/// algorithms for the topological improvement of tetrahedral meshes"; the dynamic programming is Klincsek's). A ring of
/// three is the swap 3-2, one of four 4-4. An edge on a facet that is no segment is removed from each side of it: swaps
/// 2-2 and 4-4 on facets, and larger ones.
///
/// \param edge   of the cell, 0 to 5: between its vertices 0 1, 0 2, 0 3, 1 2, 1 3, 2 3
/// \param least  the plan must be worth more; no less than the worth of the cell
/// \return       is there such a plan? It is in `change`
bool plan_edge_removal(const CellComplex& complex, const QualityGoal& goal, std::uint32_t cell, std::uint32_t edge,
                       double least, Change& change);

}  // namespace ccdt
