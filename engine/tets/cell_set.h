#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/tets/cell_complex.h"

namespace ccdt::tets {

/// Cells in the order in which they were added: a star, a cavity or a polyhedron. Its *hull* is the set of faces
/// between it and the rest of space. Reuse the object: it keeps its memory.
class CellSet {
 public:
  /// Forgets all cells.
  void clear(const CellComplex& x) {
    cells_.clear();
    if (marks_.size() < x.cell_count()) marks_.resize(x.cell_count(), 0);
    if (++search_ > 0) return;
    std::ranges::fill(marks_, std::uint16_t{0});
    ++search_;
  }
  void start(const CellComplex& x, CellId cell) {
    clear(x);
    add(cell);
  }
  void add(CellId cell) {
    marks_[cell] = search_;
    cells_.push_back(cell);
  }
  bool contains(CellId cell) const { return marks_[cell] == search_; }
  const std::vector<CellId>& cells() const { return cells_; }

  /// Visits the faces of all cells from the given place on, and adds the cell behind each face for whose code
  /// opens(code) is true.
  ///
  /// \param most  the largest number of cells
  /// \return      false if there would be more
  template <class Opens>
  bool grow(const CellComplex& x, const Opens& opens, std::size_t first = 0,
            std::size_t most = std::numeric_limits<std::size_t>::max()) {
    // Added cells are visited later in the same loop.
    for (std::size_t i = first; i < cells_.size(); ++i) {
      for (std::uint32_t f = 0; f < 4; ++f) {
        const std::uint32_t code = face_code(cells_[i], f), beyond = x.across(code);
        if (beyond == no_neighbor || contains(cell_of(beyond)) || !opens(code)) continue;
        if (cells_.size() >= most) return false;
        add(cell_of(beyond));
      }
    }
    return true;
  }

  /// All cells that are connected around a vertex; walls do not separate them.
  void gather_star(const CellComplex& x, std::uint32_t vertex) {
    start(x, x.cell_at(vertex));
    grow(x, [&](std::uint32_t code) { return x.apex_of(code) != vertex; });
  }

  /// Calls visit(code) for the faces of the hull, and for both sides of walls inside.
  template <class Visit>
  void visit_hull(const CellComplex& x, const Visit& visit) const {
    for (const CellId c : cells_)
      for (std::uint32_t f = 0; f < 4; ++f)
        if (const std::uint32_t code = face_code(c, f); x.is_wall(code) || !contains(cell_of(x.across(code))))
          visit(code);
  }

 private:
  std::vector<CellId> cells_;
  std::vector<std::uint16_t> marks_;  // by cell: the number of the last search that met it
  std::uint16_t search_ = 0;
};

/// Makes the remaining cells of a star after its vertex has moved onto another one.
///
/// \param is_good  is_good(cell) gets each cell without its quality; false ends the search
/// \return         are all good?
template <class IsGood>
bool collapse_star(const CellComplex& x, const std::vector<CellId>& star, std::uint32_t gone, std::uint32_t end,
                   const IsGood& is_good, std::vector<NewCell>& made) {
  made.clear();
  for (const CellId c : star) {
    NewCell cell{x.cell(c).vertices, x.region(c), 0};
    if (has(cell.vertices, end)) continue;
    std::ranges::replace(cell.vertices, gone, end);
    if (!is_good(cell)) return false;
    made.push_back(cell);
  }
  return true;
}

/// Are both vertices corners of one of the faces? They may be the same.
inline bool is_on_hull(const std::vector<Triangle>& hull, std::uint32_t a, std::uint32_t b) {
  return std::ranges::any_of(hull, [&](const Triangle& face) { return has(face, a) && has(face, b); });
}

/// Are those edges of the cells that are segments on their hull?
///
/// \param is_on_hull  is_on_hull(a, b): is the edge on the hull?
template <class Cells, class IsOnHull>
bool keeps_segments(const CellComplex& x, const Cells& cells, const IsOnHull& is_on_hull) {
  return std::ranges::all_of(cells, [&](CellId c) {
    const auto& v = x.cell(c).vertices;
    return std::ranges::none_of(delaunay::edge_corners, [&](const auto& corner) {
      const std::uint32_t a = v[corner[0]], b = v[corner[1]];
      return x.is_segment(a, b) && !is_on_hull(a, b);
    });
  });
}

}  // namespace ccdt::tets
