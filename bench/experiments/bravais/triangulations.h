#pragma once

#include <array>
#include <map>
#include <vector>

#include "bench/experiments/bravais/lattice_cells.h"

namespace ccdt::bravais {

using Cell = std::array<Point, 4>;  ///< a tetrahedron; its orientation does not matter

std::int64_t six_volumes_of(const Cell& cell);

using Triangulation = std::vector<Cell>;

/// All ways to divide a polytope into tetrahedra with its vertices. Each tetrahedron has a volume, and they meet in
/// whole faces. There are 3 ways for an octahedron and 74 for a cube.
std::vector<Triangulation> all_triangulations(const Polytope& polytope);

/// The same, each computed once.
class KnownTriangulations {
 public:
  const std::vector<Triangulation>& of(const Polytope& polytope);

 private:
  struct Less {
    bool operator()(const Polytope& a, const Polytope& b) const;
  };
  std::map<Polytope, std::vector<Triangulation>, Less> known_;
};

}  // namespace ccdt::bravais
