#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/improve/smoothing.h"

/// Plans of changes that replace cells. They do not change the complex; they write the best change into `change` and
/// return whether there is one. The quality of the worst new cell must be greater than `least`, which is not less than
/// that of `cell`. The new cells are not yet tested for exact positivity, except by `plan_insertion`.
namespace ccdt::improve {

/// The cells that a new vertex replaces, and their hull.
struct VertexCavity {
  std::vector<std::uint32_t> cells;
  std::vector<std::uint32_t> tried;                ///< all cells that were ever in it
  std::vector<std::array<std::uint32_t, 3>> hull;  ///< corners of its faces, the inside above
  std::vector<StarFace> faces;                     ///< the same, by their points
};

/// Working memory of the plans.
struct PlanScratch {
  CellMarks marks;
  std::vector<std::uint32_t> star;
  std::vector<NewCell> joined;
  VertexCavity cavity;
  MoveScratch move;
};

/// The quality of the worst of some cells.
double worst_of(const std::vector<NewCell>& cells);

/// The longest ring of vertices around an edge to try.
inline constexpr std::uint32_t longest_ring = 8;

/// Exactly: is a triangle not yet a face, and upright on a facet? Positive cells alone do not keep new faces from
/// folding over: a facet that is flat only within the tolerance has cells with all corners on it.
bool is_new_and_upright(const CellComplex& complex, const std::array<std::uint32_t, 3>& corners, std::uint32_t facet);

/// Plans to remove an edge: the cells around it are replaced by the best of all triangulations of the ring of vertices
/// around it, each of its triangles joined to both ends of the edge (Shewchuk 2002, "Two discrete optimization
/// algorithms for the topological improvement of tetrahedral meshes"; the dynamic programming is Klincsek's). A ring of
/// three is the swap 3-2, one of four 4-4. An edge on a facet that is not a segment is removed from each side of it:
/// swaps 2-2 and 4-4 on facets, and larger ones.
///
/// \param edge   of the cell, 0 to 5: between its vertices 0 1, 0 2, 0 3, 1 2, 1 3, 2 3
bool plan_edge_removal(const CellComplex& complex, std::uint32_t cell, std::uint32_t edge, double least,
                       Change& change);

/// Plans to remove a face, and with it more faces between the two cells' apexes: the cells on both sides of these are
/// replaced by cells around the edge between the apexes (Shewchuk 2002; the swap 2-3 is the case of one face).
///
/// \param face   of the cell, 0 to 3
bool plan_face_removal(const CellComplex& complex, std::uint32_t cell, std::uint32_t face, double least,
                       Change& change);

/// Plans to remove an interior vertex of a cell by collapsing one of the cell's edges onto the other end: the cells
/// around the vertex without that end are joined to it instead.
bool plan_collapse(const CellComplex& complex, std::uint32_t cell, double least, PlanScratch& scratch, Change& change);

/// Plans to insert a vertex in place of a cell and of those of its neighbors that the new vertex can replace by better
/// ones: the cavity grows across each face that would make a bad cell with the new vertex. The vertex then moves to the
/// position where the worst of the new cells is best (after Klingner and Shewchuk 2007). An interior vertex inside the
/// cavity is removed.
bool plan_insertion(const CellComplex& complex, std::uint32_t cell, double least, PlanScratch& scratch, Change& change);

}  // namespace ccdt::improve
