#include "engine/locate/pierced_cells.h"

#include <algorithm>
#include <array>

#include "engine/numbers/predicates.h"
#include "engine/plc/union_find.h"

namespace ccdt {
namespace {

using Corners = std::array<const Point3*, 3>;

/// The sides of the four vertices of a cell to a plane.
struct Sides {
  std::array<int, 4> of;
  int above = 0, on = 0, below = 0;

  Sides(const Corners& t, const std::array<const Point3*, 4>& cell) {
    for (int i = 0; i < 4; ++i) {
      of[i] = orient3d(*t[0], *t[1], *t[2], *cell[i]);
      ++(of[i] > 0 ? above : of[i] < 0 ? below : on);
    }
  }
};

/// Is the triangle on the outer side of a face of the cell, or on the face's plane in part?
bool is_beyond_a_face(const Corners& t, const std::array<const Point3*, 4>& cell) {
  return std::any_of(face_corners.begin(), face_corners.end(), [&](const auto& f) {
    int outside = 0;
    for (const Point3* p : t) {
      const int side = orient3d(*cell[f[0]], *cell[f[1]], *cell[f[2]], *p);
      if (side > 0) return false;
      if (side < 0) ++outside;
    }
    return outside > 0;
  });
}

/// Is the section of the cell with the triangle's plane beyond the edge ab of the triangle, or on its line in part?
bool section_is_beyond_edge(const Point3& a, const Point3& b, const std::array<const Point3*, 4>& cell,
                            const Sides& side) {
  for (int i = 0; i < 4; ++i) {
    if (side.of[i] <= 0) continue;
    // The edge from i above to j below, or to the corner j of the section, passes the line ab on the triangle's side.
    for (int j = 0; j < 4; ++j)
      if (side.of[j] <= 0 && orient3d(a, b, *cell[j], *cell[i]) > 0) return false;
  }
  if (side.above > 0) return true;
  for (int i = 0; i < 4; ++i) {
    if (side.of[i] >= 0) continue;
    for (int j = 0; j < 4; ++j)
      if (side.of[j] == 0 && orient3d(a, b, *cell[j], *cell[i]) < 0) return false;
  }
  return true;
}

/// Do the cell, closed, and the inside of the triangle meet? Exact, but for a corner of the cell alone: the inside of a
/// face of the mesh has no vertices.
bool meets(const Corners& t, const std::array<const Point3*, 4>& cell) {
  const Sides side(t, cell);
  if (side.above + (side.on < 2 ? side.on : 0) == 4 || side.below + (side.on < 2 ? side.on : 0) == 4) return false;
  if (is_beyond_a_face(t, cell)) return false;
  for (int i = 0; i < 3; ++i)
    if (section_is_beyond_edge(*t[i], *t[(i + 1) % 3], cell, side)) return false;
  return true;
}

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
    const auto& t = facets_.triangles[missing_[i]];
    const Corners corners = {&d_.point(t[0]), &d_.point(t[1]), &d_.point(t[2])};
    stack_.clear();
    for (const std::uint32_t cell : star_.around(t[0])) look_at(cell, i, corners);
    while (!stack_.empty()) {
      const std::uint32_t cell = stack_.back();
      stack_.pop_back();
      for (const std::uint32_t code : d_.cells[cell].neighbors) look_at(cell_of(code), i, corners);
    }
  }

  void look_at(std::uint32_t cell, std::uint32_t i, const Corners& t) {
    if (d_.is_ghost(cell)) return;
    Visit& visit = *visits_.insert(cell, {}).first;
    if (visit.last == i) return;
    visit.last = i;
    const auto& v = d_.cells[cell].vertices;
    if (!meets(t, {&d_.point(v[0]), &d_.point(v[1]), &d_.point(v[2]), &d_.point(v[3])})) return;
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
  FlatTable<std::uint32_t, Visit, CellTraits> visits_;
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
