#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "engine/tets/swaps.h"

/// The invariants of every change of a mesh, computed without the engine.
namespace ccdt::improve_test {

using Integer = boost::multiprecision::cpp_int;
using Tetrahedron = std::array<std::uint32_t, 4>;
using Triangle = std::array<std::uint32_t, 3>;
using Edge = std::array<std::uint32_t, 2>;

/// A small mesh, from which a complex is made.
struct Model {
  std::vector<Point3> points;
  std::vector<Tetrahedron> cells;    ///< of any orientation
  std::vector<int> regions = {};     ///< empty: all 0
  std::vector<Triangle> faces = {};  ///< on facets; missing faces of the boundary become facets of their own
  std::vector<std::uint32_t> facet_of_face = {};
  std::vector<Edge> segments = {};
  std::uint32_t first_interior = none;  ///< none is interior
};

std::vector<Point3> points_of(const tets::CellComplex& complex);

/// \return the new cells
std::vector<CellId> apply_change(tets::CellComplex& complex, tets::Change change);

/// The tetrahedra of a mesh as cells without neighbors.
LargeVector<delaunay::Cell> unjoined_cells(const mesh::TetMesh& mesh);

tets::CellComplex complex_of(Model model, const tets::QualityGoal& goal);

/// Exact sums, which stay the same as long as the same space is filled once and the facets keep their orientation.
struct Invariants {
  std::map<int, Integer> sixfold_volumes;                                ///< by region
  std::map<std::uint32_t, std::array<Integer, 3>> twofold_area_vectors;  ///< by facet
  std::map<std::uint32_t, std::size_t> face_counts;                      ///< by facet
  std::set<std::uint32_t> kept_vertices;                                 ///< in use, and not interior
  std::map<std::uint32_t, std::array<double, 3>> places = {};            ///< of these

  bool operator==(const Invariants&) const = default;
};

/// Of the living cells.
double worst_quality(const tets::CellComplex& complex);

Invariants invariants_of(const tets::CellComplex& complex);

/// The data of the complex are consistent: neighbors are mutual and share three vertices, walls are exactly at the
/// faces on facets and at the boundary, cells are exactly positive and of the quality that they say, regions end at
/// walls, each vertex knows one of its cells, and segments are edges of cells.
void expect_consistent(const tets::CellComplex& complex);

/// How many changes are possible, by kind.
struct PlanCounts {
  int edge_removals = 0, facet_flips = 0, face_removals = 0, insertions = 0, collapses = 0;
  std::set<std::uint32_t> vertices_gone = {};  ///< by any of them

  int total() const { return edge_removals + face_removals + insertions + collapses; }
};

/// Makes each change that involves any cell, in a copy of the complex. Expects that each is an improvement, that
/// everything is consistent, and that the invariants hold.
PlanCounts expect_every_plan_is_sound(const tets::CellComplex& complex);

/// The tetrahedra that are not dead, with sorted vertices.
std::set<Tetrahedron> cells_of(const tets::CellComplex& complex);

/// The edge of the cell between two vertices, or 6.
std::uint32_t edge_of_cell(const tets::CellComplex& complex, CellId cell, std::uint32_t a, std::uint32_t b);

bool has_edge(const tets::CellComplex& complex, std::uint32_t a, std::uint32_t b);

}  // namespace ccdt::improve_test
