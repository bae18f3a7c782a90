#pragma once

#include <array>
#include <cstdint>

#include "engine/tets/cell_set.h"
#include "engine/tets/fill_polyhedron.h"

namespace ccdt::steiner {

using tets::CellComplex, tets::CellSet, tets::Change;

/// How to remove a vertex, in order of effort.
enum class RemovalEffort {
  collapse,  ///< move it onto a neighbor on the segment
  fill       ///< search for other tetrahedra in place of those around it
};

/// Working memory of `plan_vertex_removal`.
struct RemovalScratch {
  CellSet star, sectors;
  tets::PolyhedronFiller filler;
  Change other;
};

/// Plans to remove a vertex inside a segment, with `neighbors` before and after it on the segment. All cells around it
/// are replaced, and on each facet the faces around it. The new cells are exactly positive.
///
/// The facets at a segment are like the pages of a book: they divide the star of a vertex on the segment into sectors.
/// Without the vertex, the faces around it on each page are replaced by a triangulation of their polygon. Then each
/// sector is a polyhedron to be filled.
///
/// The domain must not touch itself along the segment (`plc::Segment::touching`).
///
/// \return is there a plan?
bool plan_vertex_removal(const CellComplex& complex, std::uint32_t vertex,
                         const std::array<std::uint32_t, 2>& neighbors, RemovalEffort effort, RemovalScratch& scratch,
                         Change& change);

}  // namespace ccdt::steiner
