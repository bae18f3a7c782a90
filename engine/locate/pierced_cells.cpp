#include "engine/locate/pierced_cells.h"

#include <algorithm>
#include <array>

#include "engine/base/union_find.h"
#include "engine/numbers/predicates.h"

namespace ccdt {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Corners = std::array<std::uint32_t, 4>;

/// How a triangle and a cell, closed, lie to each other; vertices by id.
class Encounter {
 public:
  Encounter(const Delaunay& d, const Triangle& t, const Corners& cell) : d_(d), t_(t), cell_(cell) {
    for (int i = 0; i < 4; ++i) {
      side_[i] = orient(t[0], t[1], t[2], cell[i]);
      ++(side_[i] > 0 ? above_ : side_[i] < 0 ? below_ : on_);
    }
  }

  /// Do the cell and the inside of the triangle meet? Exact, but for a corner of the cell alone: the inside of a face
  /// of the mesh has no vertices.
  bool meets() const {
    if ((above_ == 0 || below_ == 0) && on_ < 2) return false;
    if (is_beyond_a_face()) return false;
    for (int i = 0; i < 3; ++i)
      if (section_is_beyond_edge(t_[i], t_[(i + 1) % 3])) return false;
    return true;
  }

 private:
  int orient(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    // Cells and triangles share many corners.
    if (a == b || a == c || a == d || b == c || b == d || c == d) return 0;
    return orient3d(d_.point(a), d_.point(b), d_.point(c), d_.point(d));
  }

  /// Is the triangle on the outer side of a face of the cell, or on the face's plane in part?
  bool is_beyond_a_face() const {
    return std::any_of(face_corners.begin(), face_corners.end(), [&](const auto& f) {
      int outside = 0;
      for (const std::uint32_t v : t_) {
        const int side = orient(cell_[f[0]], cell_[f[1]], cell_[f[2]], v);
        if (side > 0) return false;
        if (side < 0) ++outside;
      }
      return outside > 0;
    });
  }

  /// Is the section of the cell with the triangle's plane beyond the edge ab of the triangle, or on its line in part?
  bool section_is_beyond_edge(std::uint32_t a, std::uint32_t b) const {
    // The edge of the cell from i, above or below, to j on the other side, or the corner j of the section, passes the
    // line ab on the triangle's side. Without corners above those below tell of the corners of the section.
    const int from = above_ > 0 ? 1 : -1;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        if (side_[i] == from && side_[j] != from && orient(a, b, cell_[j], cell_[i]) == from) return false;
    return true;
  }

  const Delaunay& d_;
  const Triangle& t_;
  const Corners& cell_;
  std::array<int, 4> side_{};  // of the corners of the cell to the plane of the triangle
  int above_ = 0, on_ = 0, below_ = 0;
};

class Piercing {
 public:
  Piercing(const FacetMesh& facets, std::span<const std::uint32_t> missing, const Delaunay& d, CellStar& star)
      : facets_(facets), missing_(missing), d_(d), star_(star), parts_(missing.size()) {}

  PiercedCells find() {
    for (std::uint32_t i = 0; i < missing_.size(); ++i) flood(i);
    for (const auto& [cell, owner] : owned_)
      for (const std::uint32_t code : d_.cells[cell].neighbors)
        if (const Visit* next = visits_.find(cell_of(code)); next != nullptr && next->owner != nobody)
          parts_.join(owner, next->owner);
    return number_parts();
  }

 private:
  static constexpr std::uint32_t nobody = 0xFFFFFFFFu;

  struct Visit {
    std::uint32_t last = nobody;   ///< the missing face that was the last to come by
    std::uint32_t owner = nobody;  ///< the first that met the cell
  };

  /// Finds the cells that missing face i meets, from those around one of its corners.
  void flood(std::uint32_t i) {
    const auto& [a, b, c] = facets_.triangles[missing_[i]];
    const Triangle t = {a, b, c};
    stack_.clear();
    for (const std::uint32_t cell : star_.around(a)) look_at(cell, i, t);
    while (!stack_.empty()) {
      const std::uint32_t cell = stack_.back();
      stack_.pop_back();
      for (const std::uint32_t code : d_.cells[cell].neighbors) look_at(cell_of(code), i, t);
    }
  }

  void look_at(std::uint32_t cell, std::uint32_t i, const Triangle& t) {
    if (d_.is_ghost(cell)) return;
    Visit& visit = *visits_.insert(cell, {}).first;
    if (visit.last == i) return;
    visit.last = i;
    if (!Encounter(d_, t, d_.cells[cell].vertices).meets()) return;
    if (visit.owner == nobody) {
      visit.owner = i;
      owned_.emplace_back(cell, i);
    }
    parts_.join(visit.owner, i);
    stack_.push_back(cell);
  }

  PiercedCells number_parts() {
    PiercedCells result;
    std::vector<std::uint32_t> number(missing_.size(), nobody);
    for (std::uint32_t i = 0; i < missing_.size(); ++i) {
      std::uint32_t& part = number[parts_.find(i)];
      if (part == nobody) {
        part = static_cast<std::uint32_t>(result.cells.size());
        result.cells.emplace_back();
      }
      result.part_of_face.push_back(part);
    }
    result.part_of.reserve(owned_.size());
    for (const auto& [cell, owner] : owned_) {
      const std::uint32_t part = result.part_of_face[owner];
      result.cells[part].push_back(cell);
      result.part_of.insert(cell, part);
    }
    return result;
  }

  const FacetMesh& facets_;
  std::span<const std::uint32_t> missing_;
  const Delaunay& d_;
  CellStar& star_;
  HashTable<std::uint32_t, Visit> visits_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> owned_;  // cells and their owners
  UnionFind parts_;                                             // of missing faces
  std::vector<std::uint32_t> stack_;
};

}  // namespace

PiercedCells find_pierced_cells(const FacetMesh& facets, std::span<const std::uint32_t> missing,
                                const Delaunay& delaunay, CellStar& star) {
  return Piercing(facets, missing, delaunay, star).find();
}

}  // namespace ccdt
