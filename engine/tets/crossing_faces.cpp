#include "engine/tets/crossing_faces.h"

#include <algorithm>
#include <array>
#include <vector>

#include "engine/geometry/contacts.h"
#include "engine/geometry/predicates.h"

namespace ccdt::tets {
namespace {

/// Do two triangles share more than corners and edges?
bool cross(const CellComplex& x, const Triangle& s, const Triangle& t) {
  return cross_or_fold(s, t, [&](std::uint32_t v) { return x.point(v); });
}

/// The new faces of a facet. The space between them and the old ones consists of tetrahedra, each made of a new face
/// and a corner of the old ones. Some take space outside, others cut off space inside.
class FacetChange {
 public:
  FacetChange(const CellComplex& x, const Change& change, std::uint32_t facet) : x_(x), change_(change), facet_(facet) {
    // An old face on the boundary has one cell, another one has two.
    const auto mine = std::ranges::find_if(change.faces, [&](const FaceChange& f) { return is_mine(f); });
    const Triangle& old = x.faces()[mine->face];
    for (const CellId c : change.old_cells) {
      const auto& v = x.cell(c).vertices;
      if (!std::ranges::all_of(old, [&](std::uint32_t corner) { return has(v, corner); })) continue;
      is_on_boundary_ = inside_ == 0;
      inside_ = side_of(old, *std::ranges::find_if_not(v, [&](std::uint32_t corner) { return has(old, corner); }));
    }
  }

  bool takes_space() const {
    return is_on_boundary_ &&
           any_new([&](const FaceChange& f) { return side_of(f.corners, old_corner_of(f)) == inside_; });
  }

  bool crosses() const {
    return any_new([&](const FaceChange& f) { return meets_an_unchanged_face(f) || crosses_a_new_face(f); });
  }

 private:
  bool is_mine(const FaceChange& f) const { return x_.facet_of_face()[f.face] == facet_; }

  template <class Test>
  bool any_new(const Test& test) const {
    return std::ranges::any_of(change_.faces,
                               [&](const FaceChange& f) { return is_mine(f) && f.corners != no_corners && test(f); });
  }

  /// A corner of the old faces that the new one does not have: the removed vertex, or an end of the flipped edge.
  std::uint32_t old_corner_of(const FaceChange& f) const {
    if (change_.merge) return change_.merge->vertex;
    return *std::ranges::find_if_not(x_.faces()[f.face], [&](std::uint32_t v) { return has(f.corners, v); });
  }
  bool is_old_corner(std::uint32_t v) const {
    return std::ranges::any_of(change_.faces,
                               [&](const FaceChange& f) { return is_mine(f) && has(x_.faces()[f.face], v); });
  }

  int orient(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    return orient3d(x_.point(a), x_.point(b), x_.point(c), x_.point(d));
  }
  int side_of(const Triangle& t, std::uint32_t v) const { return orient(t[0], t[1], t[2], v); }

  bool meets_an_unchanged_face(const FaceChange& f) const {
    bool any = false;
    const Box space = hull(x_.box_of_face(f.corners), x_.box_of_face(x_.faces()[f.face]));
    x_.for_each_face_near(space, [&](std::uint32_t face) {
      if (any || std::ranges::find(change_.faces, face, &FaceChange::face) != change_.faces.end()) return;
      const Triangle& other = x_.faces()[face];
      const int first = side_of(f.corners, other[0]);
      const bool is_beside =
          first != 0 && first == side_of(f.corners, other[1]) && first == side_of(f.corners, other[2]);
      if (is_beside && first != inside_) return;
      any = (!is_beside && cross(x_, f.corners, other)) ||
            std::ranges::any_of(other, [&](std::uint32_t v) { return is_enclosed(v, f, space); }) ||
            std::ranges::all_of(other, [&](std::uint32_t v) { return is_old_corner(v); });
    });
    return any;
  }

  /// Is the vertex in the space between the new face and the old ones?
  /// \param space  a box around it
  bool is_enclosed(std::uint32_t v, const FaceChange& f, const Box& space) const {
    if (!space.meets(box_of(x_.point(v))) || is_old_corner(v)) return false;
    const auto [a, b, c] = f.corners;
    const std::uint32_t d = old_corner_of(f);
    return side_of(f.corners, v) == inside_ && side_of(f.corners, d) == inside_ && orient(a, b, v, d) != -inside_ &&
           orient(b, c, v, d) != -inside_ && orient(c, a, v, d) != -inside_;
  }

  bool crosses_a_new_face(const FaceChange& f) const {
    return std::ranges::any_of(change_.faces, [&](const FaceChange& other) {
      return !is_mine(other) && other.corners != no_corners && cross(x_, f.corners, other.corners);
    });
  }

  const CellComplex& x_;
  const Change& change_;
  const std::uint32_t facet_;
  bool is_on_boundary_ = false;
  int inside_ = 0;  ///< the sign of `orient3d` of a face of the facet and a point in the domain
};

}  // namespace

bool would_cross(const CellComplex& x, const Change& change) {
  std::vector<std::uint32_t> facets;
  for (const FaceChange& f : change.faces)
    if (const std::uint32_t facet = x.facet_of_face()[f.face]; std::ranges::find(facets, facet) == facets.end())
      facets.push_back(facet);
  return std::ranges::any_of(facets, [&](std::uint32_t facet) {
    const FacetChange changed(x, change, facet);
    return changed.takes_space() && changed.crosses();
  });
}

}  // namespace ccdt::tets
