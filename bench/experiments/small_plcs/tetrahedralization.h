#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bench/experiments/small_plcs/small_plc.h"

namespace ccdt::small_plcs {

using Tetrahedron = std::array<Vertex, 4>;  ///< in growing order

inline std::array<Point, 4> points_of(const std::vector<Point>& vertices, const Tetrahedron& t) {
  return {vertices[t[0]], vertices[t[1]], vertices[t[2]], vertices[t[3]]};
}
inline Triangle face_opposite(const Tetrahedron& t, unsigned i) {
  return triangle_of(t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]);
}

/// Has the circumsphere of a tetrahedron no vertex strictly inside?
bool is_delaunay(const std::vector<Point>& vertices, const Tetrahedron& tetrahedron);

/// The tetrahedra, one by one possible in a tetrahedralization of a PLC: not flat, in the domain, without other
/// vertices, crossed by no facet or segment.
std::vector<Tetrahedron> possible_tetrahedra(const SmallPlc& plc);

/// Do those of them that are Delaunay fill the domain and have all segments as edges? Then they are the DT of the
/// paper's Theorem 1. \pre generic, so that Delaunay tetrahedra do not overlap
bool has_delaunay_tetrahedralization(const SmallPlc& plc);

/// What an exhaustive search for constrained Delaunay tetrahedralizations has found.
struct SearchResult {
  std::size_t constrained_delaunay = 0;  ///< how many there are; a generic PLC has at most one
  bool some_is_delaunay = false;         ///< there is one whose tetrahedra are all Delaunay
  std::vector<Tetrahedron> first = {};   ///< one of them, sorted
};

/// Tries all ways to fill the domain with possible tetrahedra such that all segments are edges, all vertices are used,
/// and each face that is on no facet is locally Delaunay; these are the constrained Delaunay tetrahedralizations
/// (Shewchuk 2008, the Delaunay lemma). That the tetrahedra of a DT are Delaunay is not made use of.
SearchResult search_constrained_delaunay(const SmallPlc& plc);

}  // namespace ccdt::small_plcs
