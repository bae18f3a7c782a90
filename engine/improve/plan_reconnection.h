#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/tets/cell_complex.h"
#include "engine/tets/fill_polyhedron.h"

namespace ccdt::improve {

using tets::CellComplex, tets::CellMarks, tets::Change, tets::PolyhedronFiller;

/// Replaces the cells of a polyhedron around a bad cell by better ones with the same vertices: all at the same time,
/// where no swap makes anything better (J. Liu, B. Chen, S. Sun: Small polyhedron reconnection for mesh improvement and
/// its implementation based on advancing front technique, 2009).
class Reconnection {
 public:
  explicit Reconnection(const CellComplex& complex) : x_(complex), filler_(complex) {}

  /// Plans better cells, in larger and larger polyhedra until there are some. The polyhedra have no vertex inside, and
  /// no face or segment that must stay.
  ///
  /// \param least  all new cells are better than this
  /// \return  are there such cells?
  bool plan(std::uint32_t cell, double least, Change& change);

  /// The cells of the largest polyhedron that `plan` has looked at.
  std::span<const std::uint32_t> cells() const { return cells_; }

 private:
  void start(std::uint32_t cell);
  bool grow();
  void add_cells_inside();
  void add(std::uint32_t cell);
  bool find_hull();
  bool are_vertices_on_hull() const;
  bool are_segments_on_hull() const;
  template <class Visit>
  void visit_neighbors(std::uint32_t cell, const Visit& visit) const;

  const CellComplex& x_;
  PolyhedronFiller filler_;
  CellMarks marks_;
  std::vector<std::uint32_t> cells_, vertices_;
  std::vector<std::array<std::uint32_t, 3>> hull_;
  std::vector<std::uint64_t> edges_;  ///< of the hull, sorted
};

}  // namespace ccdt::improve
