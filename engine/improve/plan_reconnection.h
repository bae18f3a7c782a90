#pragma once

#include <cstdint>
#include <vector>

#include "engine/tets/cell_set.h"
#include "engine/tets/fill_polyhedron.h"

namespace ccdt::improve {

/// Working memory of `plan_reconnection`.
struct ReconnectionScratch {
  tets::CellSet cells;  ///< of the largest polyhedron that the last plan has looked at
  tets::PolyhedronFiller filler;
  std::vector<std::uint32_t> vertices;
  std::vector<tets::Triangle> hull;
  std::vector<std::uint64_t> edges;  ///< of the hull
};

/// Plans to replace the cells of a polyhedron around a bad cell by better ones with the same vertices, all at once,
/// where no single swap improves anything (J. Liu, B. Chen, S. Sun: Small polyhedron reconnection for mesh improvement
/// and its implementation based on advancing front technique, 2009). It tries larger and larger polyhedra. These have
/// no vertex inside, and no face or segment that must stay.
///
/// \param least  all new cells are better than this
/// \return       are there such cells?
bool plan_reconnection(const tets::CellComplex& x, CellId cell, double least, ReconnectionScratch& polyhedron,
                       tets::Change& change);

}  // namespace ccdt::improve
